// Linear elasticity in a frame that turns with each tetrahedron: large rotations, small strains.
#pragma once

#include "physics/dynamics/force_law.h"
#include "physics/dynamics/law_kernels.h"
#include "physics/material_map.h"

#include <Eigen/Dense>

#include <vector>

namespace omentum::physics {

/// What a tetrahedron's stiffness is taken to be where it is deformed.
enum class Tangent {
  kWarped,  // R K_e R^T: as if the rotation stood still; positive semi-definite everywhere
  kExact,   // the second derivative of the energy; indefinite where an element is squeezed hard
};

/// The energy of each tetrahedron, with F its gradient of deformation, V its volume at rest and R the
/// rotation nearest to F (det R = 1, also of an inverted element):
///
///     E = V (mu |F - R|^2 + lambda/2 tr(R^T F - I)^2)
///
/// This is the linear law's energy of the strain sym(R^T F) - I, and f_e = -R K_e (R^T x - X) (Mueller and
/// Gross 2004) is its exact gradient: R maximizes tr(R^T F), so that E's derivative by R vanishes along every
/// rotation, and R^T F is symmetric. (Where K_e is not isotropic, or R is not this rotation, terms in dR
/// would be missing.) Under a rigid motion the force is zero to rounding; an inverted element is driven back
/// through its shortest axis. Where two rotations are equally near (s_2 + s_3 = 0: an element squeezed to a
/// line, or turned inside out along one axis as far as it is thick along another) E has a kink, and the force
/// is that of one of its sides.
/// The rotations come from F alone, so that forces do not depend on what was before. One thread.
class Corotational final : public ForceLaw {
 public:
  /// `unit`: what computes.
  Corotational(const geometry::TetraMesh& mesh, const MaterialMap& material,
               const kernels::LawKernels& unit = *kernels::law_kernels()[0]);

  void forces(std::span<const double> u, std::span<double> f) noexcept override;
  double energy(std::span<const double> u) const noexcept override;
  void remove(geometry::TetId t) noexcept override;
  void add(geometry::TetId t) noexcept override;

  /// Takes the stiffness at `u` for product() and rotation(); a later remove() or add() is in the products,
  /// but an added tetrahedron has the tangent of when it was last there. kExact leaves out, where the
  /// rotation is ambiguous, what depends on how it turns.
  void linearize(std::span<const double> u, Tangent tangent) noexcept;
  /// f = K v, [3N], N: the force that holds v. Precondition: linearize() was called.
  void product(std::span<const double> v, std::span<double> f) const noexcept;
  /// R of tetrahedron `t` as it was linearized: its stiffness is R K_e R^T, for who assembles it.
  Eigen::Matrix3d rotation(geometry::TetId t) const noexcept;

 private:
  int pack_count() const noexcept { return static_cast<int>(packs_.size()); }

  const kernels::LawKernels* kernels_;
  std::vector<kernels::TetPack> packs_;
  std::vector<kernels::TetTangent> tangents_;
  std::vector<double> two_mu_volume_, lambda_volume_;  // [T], N m: what add() brings back
  mutable std::vector<kernels::PaddedNode> in_, out_;  // [N], scratch of one call
};

}  // namespace omentum::physics
