// Writes an organ file so that nobody ever sees half of one.
#pragma once

#include "organ/organ.h"
#include "physics/compliance_tiles.h"

#include <memory>

namespace omentum::organ {

class MappedFile;

/// Writes to FILE.partial beside the file, which finish() renames once everything is on the disk. Destroyed
/// before, it removes FILE.partial; killed, it leaves one that has no finished mark and that the next writer
/// takes over. Two writers of one file at a time: the second is refused.
class OrganWriter {
 public:
  /// Writes all but the tensors, whose room is mapped. `organ.storage` and `organ.hash` are used as they are.
  /// Throws geometry::InputError (folder missing, no permission, disk full, another writer).
  OrganWriter(const std::filesystem::path& file, const Organ& organ);
  ~OrganWriter();
  OrganWriter(const OrganWriter&) = delete;
  OrganWriter& operator=(const OrganWriter&) = delete;

  /// Where to compute the tensors: in the file's own pages. By the organ's storage one of the two is empty.
  physics::ComplianceTiles<float> single() const { return single_; }
  physics::ComplianceTiles<double> twofold() const { return twofold_; }
  std::span<float> bounds() const { return bounds_; }

  /// Tiles that are not needed again soon: their pages stay with the file, but leave the process. Any thread.
  void release(const void* begin, std::size_t bytes) const noexcept;

  /// Everything to the disk, then the finished mark, then the name. Throws geometry::InputError.
  void finish();

 private:
  void map_tensors(const Organ& organ);
  void sync() const;

  std::filesystem::path file_;
  std::filesystem::path partial_;
  int lock_ = -1;  // descriptor that holds the lock on `partial_`; -1 once finished
  std::unique_ptr<MappedFile> mapped_;
  physics::ComplianceTiles<float> single_;
  physics::ComplianceTiles<double> twofold_;
  std::span<float> bounds_;
};

}  // namespace omentum::organ
