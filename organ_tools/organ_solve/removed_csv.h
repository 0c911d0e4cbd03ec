// Tetrahedra that are taken out of an organ before it is solved.
#pragma once

#include "organ/organ.h"

#include <filesystem>
#include <vector>

namespace omentum::organ_tools {

/// Reads a column of tetrahedron numbers: that which a header calls tetrahedron, tet, element, cell or id;
/// the first one without a header. Each may be listed more than once. Throws geometry::InputError naming
/// file, line and expectation.
std::vector<geometry::TetId> read_removed(const std::filesystem::path& file, const organ::Organ& organ,
                                          geometry::Numbering numbering);

}  // namespace omentum::organ_tools
