// A file in memory by mapping.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

namespace omentum::organ {

/// Maps a file for as long as the pointer lives; the mapping is shared, so that processes that map the same
/// file share its pages. Read-only, or for writing in place. Throws geometry::InputError naming the file.
class MappedFile {
 public:
  enum class Access { kRead, kWrite };

  MappedFile(const std::filesystem::path& file, Access access);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// Lets the pages inside a range go; what was written stays with the file. Any thread.
  void release(const void* begin, std::size_t bytes) const noexcept;

  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace omentum::organ
