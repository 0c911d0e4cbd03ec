// Tetrahedra as a user lists them.
#pragma once

#include "geometry/tetra_mesh.h"

#include <filesystem>
#include <vector>

namespace omentum::organ {

/// Reads a column of tetrahedron numbers: that which a header calls tetrahedron, tet, element, cell or id;
/// the first one without a header. Each may be listed more than once. Throws geometry::InputError naming
/// file, line and expectation.
std::vector<geometry::TetId> read_tetrahedra(const std::filesystem::path& file,
                                             const geometry::TetraMesh& mesh, geometry::Numbering numbering);

}  // namespace omentum::organ
