// Stiffness of one linear tetrahedron (Cotin 1998, eq. 5 and appendix, with its slips corrected).
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/material.h"

#include <Eigen/Dense>

#include <array>

namespace omentum::physics {

using geometry::NodeId;
using geometry::Vec3;

/// The corners of a positively oriented tetrahedron, m.
using Corners = std::array<Vec3, 4>;

/// K_jk of one tetrahedron, [4][4] blocks [3 x 3], N/m: the force that holds corner j per unit displacement
/// of corner k. Symmetric: K_kj = K_jk^T; sum_k K_jk = 0.
using ElementTensors = std::array<std::array<Eigen::Matrix3d, 4>, 4>;

/// M_j, [4], m^2: twice the area of the face opposite corner j along its outward normal; sum_j M_j = 0.
/// Cotin 1998, eq. 9; as printed M_1 and M_3 point inward, so odd j change their sign here. The gradient
/// of corner j's shape function is -M_j / (6 V).
std::array<Vec3, 4> area_normals(const Corners& corners);

/// K_jk = (lambda M_j M_k^T + mu M_k M_j^T + mu (M_j . M_k) I) / (36 V). Cotin 1998, eq. 5 prints the
/// transpose. Precondition: positive volume.
ElementTensors element_tensors(const Corners& corners, const Material& material);

/// The corners of tetrahedron `t` at rest.
Corners corners_of(const geometry::TetraMesh& mesh, geometry::TetId t);

}  // namespace omentum::physics
