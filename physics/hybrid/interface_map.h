// The border of a hybrid organ whose parts do not share nodes (Cotin 1998, fig. 4b).
#pragma once

#include "geometry/surface.h"
#include "physics/stiffness.h"

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace omentum::physics {

/// Constraints u_s = sum_m P_sm u_m of the connection nodes s of a fine precomputed part by nodes m of a
/// coarse dynamic one. Every row reproduces linear fields, rigid motions among them: so P^T f has the sum and
/// the moment of forces f on the connection nodes.
struct InterfaceMap {
  std::vector<NodeId> masters;  // [m], of the dynamic mesh, ascending
  Eigen::MatrixXd P;            // [s x m]
};

/// Point by point: each connection node has the barycentric coordinates of its place in the tetrahedron
/// behind the face of the coarse boundary that is nearest to it, inside or (continued linearly) outside.
/// `slaves`: their places at rest, m.
InterfaceMap tie_pointwise(const geometry::TetraMesh& coarse, const geometry::Surface& boundary,
                           std::span<const Vec3> slaves);

/// Mortar: over the fine part's faces at the border, `faces` of places in `slaves`, the fine displacement is
/// the best approximation of the coarse one, M P = N with M_st = integral of phi_s phi_t, N_sm = integral of
/// phi_s phi_m. So it also passes a constant stress on without any error.
InterfaceMap tie_by_mortar(const geometry::TetraMesh& coarse, const geometry::Surface& boundary,
                           std::span<const Vec3> slaves, std::span<const std::array<std::int32_t, 3>> faces);

/// P^T S P, for S [3s x 3s] of the connection nodes (condensed_stiffness.h): what the precomputed part adds
/// to the dynamic one.
AddedStiffness tied(const InterfaceMap& map, const Eigen::MatrixXd& S);
/// P^T f, [3m], for f [3s]; and P u, [3s], for u [3m].
Eigen::VectorXd gathered(const InterfaceMap& map, const Eigen::VectorXd& f);
Eigen::VectorXd spread(const InterfaceMap& map, const Eigen::VectorXd& u);

}  // namespace omentum::physics
