// An organ without some of its tetrahedra.
#pragma once

#include "organ/organ.h"
#include "physics/static_solution.h"
#include "physics/stiffness.h"

#include <cstddef>
#include <span>
#include <vector>

namespace omentum::organ_tools {

/// What is left of an organ. Gravity pulls at this alone, as where an organ is cut while it moves
/// (deform_node/body_loads.h).
struct CutOrgan {
  std::vector<geometry::TetId> removed;  // those asked for, then those that hung on one node or edge
  std::size_t repaired = 0;              // how many of them nobody asked for
  physics::FixedComponents
      fixed;  // [N] the organ's; nodes that lost all tetrahedra are pinned where they are
};

/// Removes tetrahedra, and what then hangs on one node or edge (geometry::MeshEditor). Throws
/// geometry::InputError, naming a tetrahedron or node by `numbering`: for a piece that supports and `imposed`
/// do not hold, which would fall for ever, and for an imposed node that lost all tetrahedra. Without `asked`
/// the organ is taken as it is. Of a hybrid organ whose dynamic part alone is asked for, that alone is
/// repaired too.
CutOrgan cut_organ(const organ::Organ& organ, std::span<const geometry::TetId> asked,
                   std::span<const physics::ImposedDisplacement> imposed, geometry::Numbering numbering);

/// K of what is left.
physics::Stiffness stiffness_of(const organ::Organ& organ, const CutOrgan& cut);
/// Its weight, as physics::body_forces: [N], N, nothing at nodes that lost all tetrahedra; `gravity` in
/// m/s^2.
std::vector<geometry::Vec3> weights_of(const organ::Organ& organ, const CutOrgan& cut,
                                       const geometry::Vec3& gravity);

}  // namespace omentum::organ_tools
