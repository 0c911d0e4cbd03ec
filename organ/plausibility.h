// Sizes and materials that can be computed with, but can hardly be meant: another unit was in somebody's
// mind.
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/material_map.h"

#include <string>
#include <vector>

namespace omentum::organ {

/// The longest side of the mesh's box, m.
double longest_side(const geometry::TetraMesh& mesh);

/// "6.5 mm", "1.2 m".
std::string length_text(double metres);

/// A sentence each for what is outside of its range: a length of 1 cm to 1 m, a Young's modulus of 100 Pa to
/// 100 MPa, a density of 100 to 5000 kg/m^3, a Poisson's ratio of 0 to 0.495, beyond which linear tetrahedra
/// lock, and 20 tetrahedra in a region of its own material. With the value, the range and the unit that is
/// probably another one.
std::vector<std::string> implausible(const geometry::TetraMesh& mesh, const physics::MaterialMap& material);

/// "x -0.09 .. 0.1, y ... m": the mesh's box.
std::string extent_text(const geometry::TetraMesh& mesh);

}  // namespace omentum::organ
