#include "physics/tensor_solve.h"

#include "physics/direct_solve.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace omentum::physics {

namespace {

// One free component of an imposed node.
struct Row {
  std::size_t imposed;
  int axis;
};

std::vector<Row> free_rows(const geometry::Surface& surface, const FixedComponents& fixed,
                           std::span<const ImposedSurfaceNode> imposed) {
  std::vector<Row> rows;
  for (std::size_t q = 0; q < imposed.size(); ++q) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_fixed(fixed[surface.node[imposed[q].node]], axis)) rows.push_back({q, axis});
    }
  }
  return rows;
}

}  // namespace

template <class Scalar>
SurfaceSolution tensor_solve(const ComplianceTiles<const Scalar>& tiles, const geometry::Surface& surface,
                             const FixedComponents& fixed, std::span<const ImposedSurfaceNode> imposed) {
  const std::vector<Row> rows = free_rows(surface, fixed, imposed);
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd C_AA(count, count);
  Eigen::VectorXd u_star(count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const ImposedSurfaceNode& n = imposed[rows[a].imposed];
    u_star[a] = n.displacement[rows[a].axis];
    for (Eigen::Index b = 0; b < count; ++b) {
      C_AA(a, b) = tiles.at(n.node, rows[a].axis, imposed[rows[b].imposed].node, rows[b].axis);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(C_AA);
  const Eigen::VectorXd f_A =
      factor.info() == Eigen::Success ? factor.solve(u_star).eval() : Eigen::VectorXd::Constant(count, NAN);
  SurfaceSolution solution;
  solution.rcond = count > 0 ? factor.rcond() : 1;
  solution.holding_forces.assign(imposed.size(), Vec3::Zero());
  for (Eigen::Index a = 0; a < count; ++a) solution.holding_forces[rows[a].imposed][rows[a].axis] = f_A[a];
  solution.displacements.assign(tiles.mobile_count, Vec3::Zero());
  for (std::int32_t n = 0; n < tiles.mobile_count; ++n) {
    for (std::size_t q = 0; q < imposed.size(); ++q) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          solution.displacements[n][i] += tiles.at(n, i, imposed[q].node, j) * solution.holding_forces[q][j];
        }
      }
    }
  }
  const auto finite = [](const Vec3& v) { return v.allFinite(); };
  if (!std::ranges::all_of(solution.holding_forces, finite) ||
      !std::ranges::all_of(solution.displacements, finite)) {
    throw geometry::InputError("the stored tensors are damaged: they give no finite forces");
  }
  return solution;
}

std::vector<Vec3> extend_inside(const Stiffness& stiffness, const FixedComponents& fixed,
                                const geometry::Surface& surface, std::span<const Vec3> on_surface,
                                std::span<const Vec3> loads) {
  std::vector<ImposedDisplacement> imposed;
  for (const NodeId n : surface.node) imposed.push_back({n, on_surface[n]});
  return direct_solve(stiffness, fixed, imposed, loads).displacements;
}

template SurfaceSolution tensor_solve(const ComplianceTiles<const float>&, const geometry::Surface&,
                                      const FixedComponents&, std::span<const ImposedSurfaceNode>);
template SurfaceSolution tensor_solve(const ComplianceTiles<const double>&, const geometry::Surface&,
                                      const FixedComponents&, std::span<const ImposedSurfaceNode>);

}  // namespace omentum::physics
