// A file that appears at its place whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace omentum::files {

/// Where the bytes of `file` belong: itself, or the end of the links that it is, so that a link stays one.
/// Throws std::runtime_error when something is there that is no regular file: a folder, a device, a pipe, a
/// socket.
std::filesystem::path replaceable(const std::filesystem::path& file);

/// Throws as write_whole() would where that can be told beforehand: what is there is no regular file, or
/// beside it no draft can be made. Leaves nothing. For who works long before it writes.
void require_writable(const std::filesystem::path& file);

/// A draft beside `file`, which this process writes and then moves to its place; destroyed before, it is
/// removed. One thread.
class WholeFile {
 public:
  /// Makes nothing yet. Throws as replaceable() does.
  explicit WholeFile(const std::filesystem::path& file);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Where to write.
  const std::filesystem::path& draft() const { return draft_; }
  /// Throws std::runtime_error with the system's reason.
  void move_to_its_place();

 private:
  std::filesystem::path file_, target_, draft_;
  bool moved_ = false;
};

/// Replaces `file` by `text`. Throws std::runtime_error with the file and the system's reason; then nothing
/// is left and what was there stays.
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace omentum::files
