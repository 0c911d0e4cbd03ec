// A mesh in two that share no nodes, one of them finer.
#pragma once

#include "geometry/tetra_mesh.h"

namespace omentum::phantom {

using geometry::TetraMesh;

/// Each tetrahedron as eight, by the middles of its edges (the inner ones along the shortest diagonal). The
/// same shape: what lay on a face of it lies on four.
TetraMesh eight_times_finer(const TetraMesh& mesh);

struct TwoParts {
  TetraMesh upper, lower;
};

/// Tetrahedra whose centre is above a height, m, and the others, which take what would hang on them by a node
/// or an edge alone. Throws geometry::InputError where a part is no valid mesh by itself.
TwoParts parted_at(const TetraMesh& mesh, double z_m);

}  // namespace omentum::phantom
