#include "organ/organ_writer.h"

#include "organ/hdf5_file.h"
#include "organ/mapped_file.h"
#include "organ/organ_hash.h"
#include "organ/organ_layout.h"
#include "organ/tensor_check.h"

#include <cstring>

#include <fcntl.h>

namespace omentum::organ {

namespace {

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
  hdf5.write_number(layout::kYoung, organ.material.common.young_pa);
  hdf5.write_number(layout::kPoisson, organ.material.common.poisson);
  hdf5.write_number(layout::kDensity, organ.material.common.density_kg_m3);
  hdf5.write_number(layout::kFileNodes, organ.mesh.file_node_count);
  hdf5.write_number(layout::kMobile, organ.surface.mobile_count);
}

void write_regions(Hdf5File& hdf5, const Organ& organ) {
  std::vector<std::int32_t> labels;
  std::vector<physics::Material> materials;
  for (const physics::RegionMaterial& region : organ.material.regions) {
    labels.push_back(region.label);
    materials.push_back(region.material);
  }
  hdf5.write(layout::kRegions, numbers<std::int32_t>(organ.mesh.regions), {organ.mesh.regions.size()});
  hdf5.write(layout::kRegionLabels, numbers<std::int32_t>(labels), {labels.size()});
  hdf5.write(layout::kRegionMaterials, numbers<double>(materials), {materials.size(), 3});
}

void write_contents(Hdf5File& hdf5, const Organ& organ) {
  const geometry::TetraMesh& mesh = organ.mesh;
  const geometry::Surface& surface = organ.surface;
  hdf5.write(layout::kPositions, numbers<double>(mesh.positions), {mesh.positions.size(), 3});
  hdf5.write(layout::kTetrahedra, numbers<std::int32_t>(mesh.tetrahedra), {mesh.tetrahedra.size(), 4});
  hdf5.write(layout::kFileNode, numbers<std::int32_t>(mesh.file_node), {mesh.file_node.size()});
  hdf5.write(layout::kNodeNumbers, numbers<std::int64_t>(mesh.node_numbers), {mesh.node_numbers.size()});
  hdf5.write(layout::kTetrahedronNumbers, numbers<std::int64_t>(mesh.tetrahedron_numbers),
             {mesh.tetrahedron_numbers.size()});
  if (!mesh.merged.empty())
    hdf5.write(layout::kMerged, numbers<std::int32_t>(mesh.merged), {mesh.merged.size(), 2});
  if (!organ.material.regions.empty()) write_regions(hdf5, organ);
  if (organ.split) {
    const std::vector<geometry::NodeId>& nodes = organ.split->tensor_node;
    hdf5.write(layout::kDynamic, numbers<std::uint8_t>(organ.split->dynamic), {organ.split->dynamic.size()});
    hdf5.write(layout::kTensorNode, numbers<std::int32_t>(nodes), {nodes.size()});
    const BorderFaces& border = organ.split->border;
    if (!border.empty()) hdf5.write(layout::kBorder, numbers<std::int32_t>(border), {border.size(), 3});
  }
  hdf5.write(layout::kSurfaceNode, numbers<std::int32_t>(surface.node), {surface.node.size()});
  hdf5.write(layout::kTriangles, numbers<std::int32_t>(surface.triangles), {surface.triangles.size(), 3});
  hdf5.write(layout::kBehind, numbers<std::int32_t>(surface.tetrahedron), {surface.tetrahedron.size()});
  hdf5.write(layout::kFanStart, numbers<std::int32_t>(surface.fan_start), {surface.fan_start.size()});
  hdf5.write(layout::kFan, numbers<std::int32_t>(surface.fan), {surface.fan.size()});
  hdf5.write(layout::kFixed, numbers<std::uint8_t>(organ.fixed), {organ.fixed.size()});
}

}  // namespace

OrganWriter::OrganWriter(const std::filesystem::path& file, const Organ& organ) : partial_(file) {
  map_tensors(organ);
}

OrganWriter::~OrganWriter() = default;

void OrganWriter::map_tensors(const Organ& organ) {
  const std::int32_t mobile = organ.tensor_surface().mobile_count;
  const auto columns = static_cast<std::uint64_t>(mobile);
  const std::uint64_t clusters = (columns + geometry::kClusterSize - 1) / geometry::kClusterSize;
  const std::vector<std::uint64_t> shape{columns, clusters, 9, geometry::kClusterSize};
  Extent tiles, bounds;
  {
    Hdf5File hdf5(partial_.path(), Hdf5File::Mode::kCreate);
    write_attributes(hdf5, organ);
    write_contents(hdf5, organ);
    bounds = hdf5.reserve<float>(layout::kBounds, {columns, clusters});
    tiles = organ.storage == Storage::kFloat ? hdf5.reserve<float>(layout::kCompliance, shape)
                                             : hdf5.reserve<double>(layout::kCompliance, shape);
    hdf5.flush();
  }
  // Blocks for all of it now: a full disk must fail here, not as a SIGBUS while the tensors are written.
  for (const Extent& extent : {bounds, tiles}) {
    const int error = posix_fallocate(partial_.descriptor(), static_cast<off_t>(extent.offset),
                                      static_cast<off_t>(extent.bytes));
    if (error != 0) {
      throw geometry::InputError(partial_.path().string() +
                                 ": no room for the tensors: " + std::strerror(error));
    }
  }
  mapped_ = std::make_unique<MappedFile>(partial_.path(), MappedFile::Access::kWrite);
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

void OrganWriter::finish() {
  const auto done = [this](const void* begin, std::size_t bytes) { release(begin, bytes); };
  const std::string checksum = single_.values != nullptr ? tensor_checksum(single_, bounds_, done)
                                                         : tensor_checksum(twofold_, bounds_, done);
  single_ = {};
  twofold_ = {};
  bounds_ = {};
  mapped_.reset();
  partial_.sync();
  {
    Hdf5File hdf5(partial_.path(), Hdf5File::Mode::kUpdate);
    hdf5.write_text(layout::kChecksum, checksum);
    hdf5.write_number(layout::kFinished, 1);
    hdf5.flush();
  }
  partial_.sync();
  partial_.move_to_its_place();
}

}  // namespace omentum::organ
