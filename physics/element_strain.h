// How one tetrahedron is strained, and what Hooke's law makes of it.
#pragma once

#include "geometry/tetra_mesh.h"

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace omentum::physics {

/// [3 x 3], the edges from corner 0 to the others as columns.
Eigen::Matrix3d edges_from_first(const std::array<geometry::Vec3, 4>& corners);

/// F, the gradient of deformation, of each tetrahedron of a mesh: constant in it, and 1 at rest. Any thread.
class DeformationGradients {
 public:
  /// `mesh` must outlive this.
  explicit DeformationGradients(const geometry::TetraMesh& mesh);

  /// `displacements`: [3N], from rest, m.
  Eigen::Matrix3d at(geometry::TetId t, std::span<const double> displacements) const noexcept;
  double volume_m3(geometry::TetId t) const noexcept { return rest_[t].volume_m3; }

 private:
  struct Rest {
    Eigen::Matrix3d inverse;  // of the edges from corner 0, 1/m
    double volume_m3;
  };
  const geometry::TetraMesh& mesh_;
  std::vector<Rest> rest_;  // [T]
};

/// (F + F^T) / 2 - I: the linear law's.
Eigen::Matrix3d linear_strain(const Eigen::Matrix3d& F) noexcept;
/// (F^T F - I) / 2: Green's; rigid motion gives 0.
Eigen::Matrix3d green_strain(const Eigen::Matrix3d& F) noexcept;
/// sym(R^T F) - I with R the rotation nearest to F, det R = 1: the co-rotational law's (corotational.h). It
/// is U - I of F = R U, but for an element that is turned inside out, whose shortest axis counts as negative.
/// Exact to 1e-9 of its norm for any F.
Eigen::Matrix3d turned_strain(const Eigen::Matrix3d& F) noexcept;

/// Hooke's law: lambda tr(e) I + 2 mu e, Pa.
Eigen::Matrix3d hooke_stress(double lambda_pa, double mu_pa, const Eigen::Matrix3d& strain) noexcept;

/// The largest eigenvalue of a symmetric matrix: tension has the positive sign.
double largest_principal(const Eigen::Matrix3d& symmetric) noexcept;

}  // namespace omentum::physics
