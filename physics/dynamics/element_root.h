// A square root of one tetrahedron's stiffness.
#pragma once

#include "physics/element_tensors.h"

namespace omentum::physics {

/// W [12 x 6], W W^T = K_e, rows x y z of each corner: the stiffness of a linear tetrahedron is
/// V B^T D B with the six strains of its displacements, so that W = sqrt(V) B^T D^(1/2).
/// Precondition: positive volume.
using ElementRoot = Eigen::Matrix<double, 12, 6>;

ElementRoot element_root(const Corners& corners, const Material& material);

}  // namespace omentum::physics
