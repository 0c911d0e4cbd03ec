// Writes an organ file so that nobody ever sees half of one.
#pragma once

#include "organ/organ.h"
#include "organ/partial_file.h"
#include "physics/compliance_tiles.h"

#include <memory>

namespace omentum::organ {

class MappedFile;

/// Writes to a PartialFile, which finish() moves to its place once everything is on the disk. Destroyed
/// before, it leaves nothing; killed, a partial file without a finished mark, which the next writer in the
/// folder removes. Two writers of one file at a time: the second is refused.
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

  /// Everything to the disk, then checksum and finished mark, then the name. Throws geometry::InputError.
  void finish();

 private:
  void map_tensors(const Organ& organ);

  PartialFile partial_;
  std::unique_ptr<MappedFile> mapped_;
  physics::ComplianceTiles<float> single_;
  physics::ComplianceTiles<double> twofold_;
  std::span<float> bounds_;
};

}  // namespace omentum::organ
