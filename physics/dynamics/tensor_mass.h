// The tensor-mass model: linear elasticity over a mesh that is cut (Cotin 1998, section 5).
#pragma once

#include "physics/dynamics/edge_blocks.h"
#include "physics/dynamics/force_law.h"

namespace omentum::physics {

/// f_n = -sum_k K_nk (u_k - u_n) over the neighbours k: Cotin 1998, eq. 6 with its sign, and K_nn as minus
/// the sum of the others, so that a translation gives no force at all and rounding goes with the strain
/// instead of the displacement.
class TensorMass final : public ForceLaw {
 public:
  /// In what the forces are computed; energy and tensors are always in double.
  enum class Arithmetic { kFloat, kDouble };

  /// `mesh` outlives the model. `kernel`: what computes the forces in float.
  TensorMass(const geometry::TetraMesh& mesh, const MaterialMap& material,
             Arithmetic arithmetic = Arithmetic::kFloat,
             const kernels::EdgeKernel& kernel = kernels::edge_kernels().front());

  void forces(std::span<const double> u, std::span<double> f) noexcept override;
  double energy(std::span<const double> u) const noexcept override;
  void remove(geometry::TetId t) noexcept override;
  void add(geometry::TetId t) noexcept override;

  const TensorBooks& books() const { return books_; }
  const EdgeBlocks& blocks() const { return blocks_; }

 private:
  void forces_in_double(std::span<const double> u, std::span<double> f) const noexcept;
  void refresh(geometry::TetId t) noexcept;

  TensorBooks books_;
  EdgeBlocks blocks_;
  Arithmetic arithmetic_;
  kernels::EdgeForces edge_forces_;
  AlignedFloats scratch_;  // [N][kNodeStride]
};

}  // namespace omentum::physics
