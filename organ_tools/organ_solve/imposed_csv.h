// Imposed displacements as a user lists them.
#pragma once

#include "organ/organ.h"
#include "physics/static_solution.h"

#include <filesystem>
#include <vector>

namespace omentum::organ_tools {

/// Reads "node,ux,uy,uz" (node number of the mesh file, m), a header allowed. Throws geometry::InputError
/// naming file, line and node for a malformed line, an unknown, unused or repeated node, a pinned node, a
/// displacement other than zero in a component that a support holds, and one beyond largest_displacement.
std::vector<physics::ImposedDisplacement> read_imposed(const std::filesystem::path& file,
                                                       const organ::Organ& organ);

}  // namespace omentum::organ_tools
