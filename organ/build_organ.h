// From a checked mesh, a material and supports to an organ file.
#pragma once

#include "organ/organ.h"

#include <functional>
#include <stdexcept>

namespace omentum::organ {

struct BuildOptions {
  bool force = false;  // build even when the file is up to date
  int threads = 1;     // workers over the columns
  std::function<void(const std::string& stage, double fraction)> on_progress;  // may be empty
  std::function<bool()> stopped;  // asked every few milliseconds, by several threads; may be empty
};

struct BuildResult {
  bool up_to_date = false;   // the file was left as it is
  std::int32_t columns = 0;  // free degrees of freedom of mobile surface nodes
  double factor_s = 0;       // assembly, ordering and factorization
  double columns_s = 0;      // all columns, into the file's pages
  double total_s = 0;        // with writing to the disk
};

/// The build was stopped; no file was made or changed.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An organ ready to be built: surface extracted, hash computed. Its mesh keeps labels of regions only where
/// one has a material of its own (region_spec.h). `dynamic`: [T] of a hybrid organ, or empty; `border`: where
/// its parts touch, if they share no nodes (joined_parts.h). Throws geometry::InputError for a material out
/// of range, supports that leave the organ floating or nothing free, and as split_organ does.
Organ make_organ(std::string name, geometry::TetraMesh mesh, const physics::MaterialMap& material,
                 FixedComponents fixed, Storage storage, std::vector<std::uint8_t> dynamic = {},
                 BorderFaces border = {});

/// Whether `file` is a finished organ file with this organ's hash and name and whole tensors (all are read).
bool is_up_to_date(const std::filesystem::path& file, const Organ& organ);

/// Computes the force tensors into `file`. Whole or not at all (OrganWriter). Throws geometry::InputError,
/// Interrupted.
BuildResult build_organ(const Organ& organ, const std::filesystem::path& file, const BuildOptions& options);

}  // namespace omentum::organ
