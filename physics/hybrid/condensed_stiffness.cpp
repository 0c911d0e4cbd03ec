#include "physics/hybrid/condensed_stiffness.h"

#include "geometry/tetra_mesh.h"

namespace omentum::physics {

template <class Scalar>
Eigen::MatrixXd compliance_among(const ComplianceTiles<const Scalar>& tiles,
                                 std::span<const SurfaceId> nodes) {
  const auto count = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd C(3 * count, 3 * count);
  for (Eigen::Index a = 0; a < 3 * count; ++a) {
    for (Eigen::Index b = 0; b < 3 * count; ++b) {
      C(a, b) = tiles.at(nodes[static_cast<std::size_t>(a / 3)], static_cast<int>(a % 3),
                         nodes[static_cast<std::size_t>(b / 3)], static_cast<int>(b % 3));
    }
  }
  return C;
}

Eigen::MatrixXd condensed_stiffness(Eigen::MatrixXd C_AA) {
  for (Eigen::Index c = 0; c < C_AA.rows(); ++c)
    if (C_AA(c, c) == 0) C_AA(c, c) = 1;
  const Eigen::LLT<Eigen::MatrixXd> factor(C_AA);
  if (factor.info() != Eigen::Success)
    throw geometry::InputError(
        "the stored tensors are damaged: they give no stiffness of the connection nodes");
  const Eigen::MatrixXd S = factor.solve(Eigen::MatrixXd::Identity(C_AA.rows(), C_AA.cols()));
  return (S + S.transpose()) / 2;
}

template Eigen::MatrixXd compliance_among(const ComplianceTiles<const float>&, std::span<const SurfaceId>);
template Eigen::MatrixXd compliance_among(const ComplianceTiles<const double>&, std::span<const SurfaceId>);

}  // namespace omentum::physics
