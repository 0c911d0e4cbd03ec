#include "organ/organ_writer.h"

#include "organ/hdf5_file.h"
#include "organ/mapped_file.h"
#include "organ/organ_hash.h"
#include "organ/organ_layout.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace omentum::organ {

namespace {

using geometry::InputError;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what, int error) {
  throw InputError(file.string() + ": " + what + ": " + std::strerror(error));
}

// Opens and locks the partial file. A lock of the open file description: HDF5's own lock and its closing of
// other descriptors do not touch it.
int lock_partial(const std::filesystem::path& partial) {
  while (true) {
    const int descriptor = open(partial.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(partial, "cannot be written", errno);
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    if (fcntl(descriptor, F_OFD_SETLK, &whole) != 0) {
      const int error = errno;
      close(descriptor);
      fail(partial, "is being written by another process", error);
    }
    // its writer may have finished and renamed it between our open and our lock
    struct stat mine {
    }, there{};
    if (fstat(descriptor, &mine) == 0 && stat(partial.c_str(), &there) == 0 && mine.st_ino == there.st_ino) {
      return descriptor;
    }
    close(descriptor);
  }
}

// A list of Ts as the numbers that they are made of.
template <class Number, class T>
std::span<const Number> numbers(const std::vector<T>& values) {
  static_assert(sizeof(T) % sizeof(Number) == 0);
  return {reinterpret_cast<const Number*>(values.data()), values.size() * sizeof(T) / sizeof(Number)};
}

void write_attributes(Hdf5File& hdf5, const Organ& organ) {
  hdf5.write_text(layout::kFormat, layout::kFormatName);
  hdf5.write_number(layout::kVersion, kFormatVersion);
  hdf5.write_text(layout::kHash, organ.hash);
  hdf5.write_text(layout::kStorage, organ.storage == Storage::kDouble ? "double" : "float");
  hdf5.write_text(layout::kName, organ.name);
  hdf5.write_number(layout::kYoung, organ.material.young_pa);
  hdf5.write_number(layout::kPoisson, organ.material.poisson);
  hdf5.write_number(layout::kDensity, organ.material.density_kg_m3);
  hdf5.write_number(layout::kFileNodes, organ.mesh.file_node_count);
  hdf5.write_number(layout::kMobile, organ.surface.mobile_count);
}

void write_contents(Hdf5File& hdf5, const Organ& organ) {
  const geometry::TetraMesh& mesh = organ.mesh;
  const geometry::Surface& surface = organ.surface;
  hdf5.write(layout::kPositions, numbers<double>(mesh.positions), {mesh.positions.size(), 3});
  hdf5.write(layout::kTetrahedra, numbers<std::int32_t>(mesh.tetrahedra), {mesh.tetrahedra.size(), 4});
  hdf5.write(layout::kFileNode, numbers<std::int32_t>(mesh.file_node), {mesh.file_node.size()});
  hdf5.write(layout::kSurfaceNode, numbers<std::int32_t>(surface.node), {surface.node.size()});
  hdf5.write(layout::kTriangles, numbers<std::int32_t>(surface.triangles), {surface.triangles.size(), 3});
  hdf5.write(layout::kBehind, numbers<std::int32_t>(surface.tetrahedron), {surface.tetrahedron.size()});
  hdf5.write(layout::kFanStart, numbers<std::int32_t>(surface.fan_start), {surface.fan_start.size()});
  hdf5.write(layout::kFan, numbers<std::int32_t>(surface.fan), {surface.fan.size()});
  hdf5.write(layout::kFixed, numbers<std::uint8_t>(organ.fixed), {organ.fixed.size()});
}

}  // namespace

OrganWriter::OrganWriter(const std::filesystem::path& file, const Organ& organ)
    : file_(file), partial_(file.string() + ".partial"), lock_(lock_partial(partial_)) {
  try {
    map_tensors(organ);
  } catch (...) {
    unlink(partial_.c_str());
    close(lock_);
    throw;
  }
}

OrganWriter::~OrganWriter() {
  if (lock_ < 0) return;
  unlink(partial_.c_str());
  close(lock_);
}

void OrganWriter::map_tensors(const Organ& organ) {
  const std::int32_t mobile = organ.surface.mobile_count;
  const auto columns = static_cast<std::uint64_t>(mobile);
  const std::uint64_t clusters = (columns + geometry::kClusterSize - 1) / geometry::kClusterSize;
  const std::vector<std::uint64_t> shape{columns, clusters, 9, geometry::kClusterSize};
  Extent tiles, bounds;
  {
    Hdf5File hdf5(partial_, Hdf5File::Mode::kCreate);
    write_attributes(hdf5, organ);
    write_contents(hdf5, organ);
    bounds = hdf5.reserve<float>(layout::kBounds, {columns, clusters});
    tiles = organ.storage == Storage::kFloat ? hdf5.reserve<float>(layout::kCompliance, shape)
                                             : hdf5.reserve<double>(layout::kCompliance, shape);
    hdf5.flush();
  }
  // Blocks for all of it now: a full disk must fail here, not as a SIGBUS while the tensors are written.
  for (const Extent& extent : {bounds, tiles}) {
    const int error =
        posix_fallocate(lock_, static_cast<off_t>(extent.offset), static_cast<off_t>(extent.bytes));
    if (error != 0) fail(partial_, "no room for the tensors", error);
  }
  mapped_ = std::make_unique<MappedFile>(partial_, MappedFile::Access::kWrite);
  std::byte* const there = mapped_->data() + tiles.offset;
  if (organ.storage == Storage::kFloat) {
    single_ = {mobile, reinterpret_cast<float*>(there)};
  } else {
    twofold_ = {mobile, reinterpret_cast<double*>(there)};
  }
  bounds_ = {reinterpret_cast<float*>(mapped_->data() + bounds.offset), bounds.bytes / sizeof(float)};
}

void OrganWriter::release(const void* begin, std::size_t bytes) const noexcept {
  mapped_->release(begin, bytes);
}

void OrganWriter::sync() const {
  if (fsync(lock_) != 0) fail(partial_, "cannot be written", errno);
}

void OrganWriter::finish() {
  single_ = {};
  twofold_ = {};
  bounds_ = {};
  mapped_.reset();
  sync();
  {
    Hdf5File hdf5(partial_, Hdf5File::Mode::kUpdate);
    hdf5.write_number(layout::kFinished, 1);
    hdf5.flush();
  }
  sync();
  if (rename(partial_.c_str(), file_.c_str()) != 0) fail(file_, "cannot be replaced", errno);
  close(lock_);
  lock_ = -1;
  // the new name itself to the disk; a folder that cannot be opened for this has it there soon enough
  const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    fsync(descriptor);
    close(descriptor);
  }
}

}  // namespace omentum::organ
