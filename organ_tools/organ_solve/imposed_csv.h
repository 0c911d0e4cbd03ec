// Imposed displacements as a user lists them.
#pragma once

#include "organ/organ.h"
#include "physics/static_solution.h"

#include <filesystem>
#include <vector>

namespace omentum::organ_tools {

/// Reads lines of node,ux,uy,uz (m), in this order or, in any order and beside other columns, as a header
/// names them (nodes: node_column.h). A node that was merged into another one stands for that one; both may
/// be listed with the same displacement. Throws geometry::InputError naming file, line and node for a
/// malformed line, an unknown, unused or repeated node, a pinned node, a displacement other than zero in a
/// component that a support holds, and one beyond largest_displacement.
std::vector<physics::ImposedDisplacement> read_imposed(const std::filesystem::path& file,
                                                       const organ::Organ& organ,
                                                       geometry::Numbering numbering);

}  // namespace omentum::organ_tools
