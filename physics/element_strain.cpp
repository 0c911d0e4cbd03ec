#include "physics/element_strain.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace omentum::physics {

namespace {

using geometry::Vec3;

std::array<Vec3, 4> corners_at_rest(const geometry::TetraMesh& mesh, const geometry::Tetrahedron& nodes) {
  std::array<Vec3, 4> x;
  for (std::size_t c = 0; c < 4; ++c) x[c] = mesh.positions[nodes[c]];
  return x;
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
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  // of E and not of F^T F, whose 1 would cost half of a small strain's digits
  solver.computeDirect(green_strain(F));
  Eigen::Vector3d stretch = (2 * solver.eigenvalues().array() + 1).max(0).sqrt();
  Eigen::Vector3d strain = 2 * solver.eigenvalues().array() / (stretch.array() + 1);
  if (F.determinant() < 0) strain[0] = -stretch[0] - 1;
  return solver.eigenvectors() * strain.asDiagonal() * solver.eigenvectors().transpose();
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
