#include "physics/dynamics/tensor_mass.h"

#include "geometry/precondition.h"

#include <algorithm>

namespace omentum::physics {

namespace {

Eigen::Map<const Vec3> at(std::span<const double> values, NodeId n) {
  return Eigen::Map<const Vec3>(values.data() + 3 * static_cast<std::size_t>(n));
}

Eigen::Map<Vec3> at(std::span<double> values, NodeId n) {
  return Eigen::Map<Vec3>(values.data() + 3 * static_cast<std::size_t>(n));
}

}  // namespace

TensorMass::TensorMass(const geometry::TetraMesh& mesh, const MaterialMap& material, Arithmetic arithmetic,
                       const kernels::EdgeKernel& kernel)
    : books_(mesh, material),
      blocks_(books_),
      arithmetic_(arithmetic),
      edge_forces_(kernel.forces),
      scratch_(kernels::kNodeStride * books_.node_count()) {
  for (std::size_t e = 0; e < books_.edges().size(); ++e)
    blocks_.refresh(books_, static_cast<std::int32_t>(e));
}

void TensorMass::forces(std::span<const double> u, std::span<double> f) noexcept {
  geometry::require(u.size() == 3 * books_.node_count() && f.size() == u.size(),
                    "three values for each node");
  if (arithmetic_ == Arithmetic::kFloat) {
    edge_forces_(blocks_.slices(), u.data(), scratch_.data(), f.data());
  } else {
    forces_in_double(u, f);
  }
}

void TensorMass::forces_in_double(std::span<const double> u, std::span<double> f) const noexcept {
  std::ranges::fill(f, 0.0);
  for (std::size_t e = 0; e < books_.edges().size(); ++e) {
    const auto [a, b] = books_.edges()[e];
    const Eigen::Matrix3d& K_ab = books_.edge(e);
    const Vec3 d = at(u, b) - at(u, a);
    at(f, a) -= K_ab * d;
    at(f, b) += K_ab.transpose() * d;
  }
}

double TensorMass::energy(std::span<const double> u) const noexcept {
  // u^T K u with each row's own tensor as minus the sum of the others
  double twice = 0;
  for (std::size_t e = 0; e < books_.edges().size(); ++e) {
    const auto [a, b] = books_.edges()[e];
    const Eigen::Matrix3d& K_ab = books_.edge(e);
    const Vec3 d = at(u, b) - at(u, a);
    twice += at(u, a).dot(K_ab * d) - at(u, b).dot(K_ab.transpose() * d);
  }
  return twice / 2;
}

void TensorMass::remove(geometry::TetId t) noexcept {
  books_.remove(t);
  refresh(t);
}

void TensorMass::add(geometry::TetId t) noexcept {
  books_.add(t);
  refresh(t);
}

void TensorMass::refresh(geometry::TetId t) noexcept {
  for (const std::int32_t e : books_.edges_of(t)) blocks_.refresh(books_, e);
}

}  // namespace omentum::physics
