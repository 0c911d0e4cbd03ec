#include "physics/element_strain.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace omentum::physics {

namespace {

using geometry::Vec3;

std::array<Vec3, 4> corners_at_rest(const geometry::TetraMesh& mesh, const geometry::Tetrahedron& nodes) {
  std::array<Vec3, 4> x;
  for (std::size_t c = 0; c < 4; ++c) x[c] = mesh.positions[nodes[c]];
  return x;
}

// Below this share of the longest axis the shortest one costs the closed form more than three digits.
constexpr double kLeastFlat = 1e-3;

// Eigenvalues of a symmetric matrix, the largest first, by the angle of its deviator's third invariant. Two
// that are close are off by the root of a rounding to opposite sides: their symmetric functions are exact.
Eigen::Vector3d principal_values(const Eigen::Matrix3d& symmetric) noexcept {
  constexpr double kNone = 1e-100;  // its third power is a number still
  const double mean = symmetric.trace() / 3;
  const Eigen::Matrix3d deviator = symmetric - mean * Eigen::Matrix3d::Identity();
  const double p = std::sqrt(deviator.squaredNorm() / 6);
  if (!(p > kNone)) return Eigen::Vector3d::Constant(mean);
  const double third = deviator.determinant() / (2 * p * p * p);
  const double c = std::cos(std::acos(std::clamp(third, -1.0, 1.0)) / 3);
  const double across = std::sqrt(3 * std::max(0.0, 1 - c * c));
  return {mean + 2 * p * c, mean - p * (c - across), mean - p * (c + across)};
}

// Of elements that are inside out or nearly flat, whose eigenvalues of E do not tell it exactly.
Eigen::Matrix3d strain_by_axes(const Eigen::Matrix3d& F) noexcept {
  const Eigen::JacobiSVD<Eigen::Matrix3d> axes(F, Eigen::ComputeFullV);
  Eigen::Vector3d strain = axes.singularValues().array() - 1;
  if (F.determinant() < 0) strain[2] = -axes.singularValues()[2] - 1;
  return axes.matrixV() * strain.asDiagonal() * axes.matrixV().transpose();
}

}  // namespace

Eigen::Matrix3d edges_from_first(const std::array<Vec3, 4>& corners) {
  Eigen::Matrix3d D;
  D << corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0];
  return D;
}

DeformationGradients::DeformationGradients(const geometry::TetraMesh& mesh) : mesh_(mesh) {
  rest_.reserve(mesh.tetrahedra.size());
  for (const geometry::Tetrahedron& nodes : mesh.tetrahedra) {
    const Eigen::Matrix3d D = edges_from_first(corners_at_rest(mesh, nodes));
    rest_.push_back({D.inverse(), D.determinant() / 6});
  }
}

Eigen::Matrix3d DeformationGradients::at(geometry::TetId t,
                                         std::span<const double> displacements) const noexcept {
  std::array<Vec3, 4> u;
  for (std::size_t c = 0; c < 4; ++c)
    u[c] = Eigen::Map<const Vec3>(displacements.data() + 3 * mesh_.tetrahedra[t][c]);
  return Eigen::Matrix3d::Identity() + edges_from_first(u) * rest_[t].inverse;
}

Eigen::Matrix3d linear_strain(const Eigen::Matrix3d& F) noexcept {
  return 0.5 * (F + F.transpose()) - Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d green_strain(const Eigen::Matrix3d& F) noexcept {
  return 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity());
}

Eigen::Matrix3d turned_strain(const Eigen::Matrix3d& F) noexcept {
  // E and not C = I + 2 E, whose 1 would cost half of a small strain's digits
  const Eigen::Matrix3d E = green_strain(F);
  const Eigen::Vector3d u = (2 * principal_values(E).array() + 1).max(0).sqrt();
  if (!(F.determinant() > 0 && u[2] > kLeastFlat * u[0])) return strain_by_axes(F);
  const double i1 = u.sum(), i2 = u[0] * u[1] + u[1] * u[2] + u[2] * u[0], i3 = u.prod();
  // Cayley and Hamilton's U (C + i2 I) = i1 C + i3 I with C = I + 2 E, less C + i2 I on both sides
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const double product = 8 * E.determinant() / (1 + i1 + i2 + i3);  // of the strains
  const Eigen::Matrix3d strain =
      (2 * (i1 - 1) * E + product * I) * Eigen::Matrix3d(2 * E + (1 + i2) * I).inverse();
  return 0.5 * (strain + strain.transpose());
}

Eigen::Matrix3d hooke_stress(double lambda_pa, double mu_pa, const Eigen::Matrix3d& strain) noexcept {
  return lambda_pa * strain.trace() * Eigen::Matrix3d::Identity() + 2 * mu_pa * strain;
}

double largest_principal(const Eigen::Matrix3d& symmetric) noexcept {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

}  // namespace omentum::physics
