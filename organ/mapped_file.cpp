#include "organ/mapped_file.h"

#include "geometry/tetra_mesh.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace omentum::organ {

MappedFile::MappedFile(const std::filesystem::path& file, Access access) {
  const bool writing = access == Access::kWrite;
  const int descriptor = open(file.c_str(), (writing ? O_RDWR : O_RDONLY) | O_CLOEXEC);
  struct stat status {};
  void* mapped = MAP_FAILED;
  if (descriptor >= 0 && fstat(descriptor, &status) == 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    mapped = mmap(nullptr, size_, writing ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, descriptor, 0);
  }
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (mapped == MAP_FAILED) {
    throw geometry::InputError(file.string() + ": cannot be mapped: " + std::strerror(error));
  }
  data_ = static_cast<std::byte*>(mapped);
}

MappedFile::~MappedFile() {
  munmap(data_, size_);
}

void MappedFile::release(const void* begin, std::size_t bytes) const noexcept {
  // whole pages only, seen from the mapping, which begins at one
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto offset = static_cast<std::size_t>(static_cast<const std::byte*>(begin) - data_);
  const std::size_t first = (offset + page - 1) / page * page;
  const std::size_t end = (offset + bytes) / page * page;
  if (end > first) madvise(data_ + first, end - first, MADV_DONTNEED);
}

}  // namespace omentum::organ
