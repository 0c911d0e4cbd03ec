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

}  // namespace omentum::organ
