// A file that is written beside its place, so that nobody ever sees half of one.
#pragma once

#include <filesystem>

namespace omentum::organ {

/// FILE.omentum-partial beside FILE, empty and locked until it is moved to its place; destroyed before, it is
/// removed. The lock belongs to this process and ends with it, however it ends: what has none is nobody's any
/// more. One thread.
class PartialFile {
 public:
  /// Removes what dead processes left in the folder (remove_abandoned), then makes or takes over the partial
  /// file. A link stays one: its end is replaced. Throws geometry::InputError (FILE is no regular file,
  /// folder missing, no permission, another process writes FILE).
  explicit PartialFile(const std::filesystem::path& file);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// Where to write.
  const std::filesystem::path& path() const { return partial_; }
  /// Open for reading and writing; -1 once moved.
  int descriptor() const { return lock_; }

  /// What was written to the disk. Throws geometry::InputError.
  void sync() const;
  /// Replaces FILE. Throws geometry::InputError.
  void move_to_its_place();

 private:
  std::filesystem::path file_;
  std::filesystem::path partial_;
  int lock_ = -1;
};

/// Removes partial files in `folder` that no living process holds; says how many. What cannot be opened is
/// left.
int remove_abandoned(const std::filesystem::path& folder) noexcept;

}  // namespace omentum::organ
