// What the check of a mesh has found, in sentences that name the file's nodes and tetrahedra.
#pragma once

#include "geometry/mesh_topology.h"
#include "geometry/tetra_mesh.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace omentum::geometry {

/// Reasons to refuse a mesh, collected until it is refused, and warnings. Of offenders the first few are
/// named and the others counted. `raw` outlives it.
class MeshFindings {
 public:
  MeshFindings(const RawMesh& raw, Numbering numbering)
      : raw_(raw),
        nodes_(raw.node_numbers, raw.positions.size(), numbering),
        tetrahedra_(raw.tetrahedron_numbers, raw.tetrahedra.size(), numbering) {}

  /// From now on tetrahedra are counted among these, places in the file.
  void count_tetrahedra_among(std::vector<std::size_t> kept) { kept_ = std::move(kept); }

  std::string node(std::size_t n) const { return "node " + std::to_string(nodes_.of(n)); }
  std::string tetrahedron(std::size_t t) const;
  /// " 17, 18, 19", or " 17, 18, 19, 20, 21, ... (12 in all)".
  std::string list_tetrahedra(const Offenders& which) const;

  /// Refuses where there are any; they may be named several times, in any order.
  void refuse_tetrahedra(const Offenders& which, const std::string& what);
  void refuse_nodes(Offenders which, const std::string& what);
  /// Refuses nodes at the same place, before all else: what else is wrong may follow from it.
  void refuse_twins(std::span<const std::pair<std::int32_t, std::int32_t>> pairs);

  bool refused() const { return !reasons_.empty(); }
  /// Throws InputError with all reasons, where there are any.
  void stop_if_refused() const;

  void warn(const std::string& what) { warnings_.push_back(raw_.source + ": " + what); }
  /// Nothing where the count is 0.
  void warn(std::size_t count, const char* singular, const char* plural);
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::size_t place_in_file(std::size_t t) const { return kept_.empty() ? t : kept_[t]; }

  const RawMesh& raw_;
  FileNumbers nodes_, tetrahedra_;
  std::vector<std::size_t> kept_;  // empty: all of the file
  std::vector<std::string> reasons_, warnings_;
};

}  // namespace omentum::geometry
