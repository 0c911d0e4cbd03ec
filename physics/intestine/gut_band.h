// The constant matrix of an intestine's implicit steps, factorized.
#pragma once

#include "physics/dynamics/padded_nodes.h"
#include "physics/intestine/gut_springs.h"

#include <cstddef>
#include <span>
#include <vector>

namespace omentum::physics {

/// A = M (1 + dt drag) / dt^2 + (1 + tau / dt) K over the free masses, with the springs K as if they had no
/// direction: one scalar matrix for x, y and z. It is never below the true stiffness of the step, so that
/// steps with it go downhill (projective dynamics, Bouaziz et al. 2014). Numbered column by column it is a
/// narrow band, and its Cholesky factor too. Constant.
class GutBand {
 public:
  using Node = kernels::PaddedNode;

  GutBand(const GutSprings& springs, double step_s);

  std::size_t size() const { return diagonal_.size(); }  // free masses
  /// Place of a mass that is free, in [0, size).
  std::size_t place(geometry::MassId m) const;
  geometry::MassId mass(std::size_t place) const { return masses_[place]; }
  /// The free masses in the band's order, [size].
  std::span<const geometry::MassId> masses() const { return masses_; }

  /// b becomes A^-1 b: m from N. [size]. Allocates nothing.
  void solve(Node* b) const noexcept;
  /// The diagonal of A^-1, [size], m/N, from the factor's own entries alone (Takahashi et al. 1973).
  std::vector<double> diagonal_of_inverse() const;

 private:
  void factorize(const GutSprings& springs, double step_s);

  geometry::GutLayout layout_;
  std::vector<geometry::MassId> masses_;
  std::size_t width_;             // entries of a row of the factor left of its diagonal
  std::vector<double> lower_;     // [size][width]: L with unit diagonal, the last one next to it
  std::vector<double> upper_;     // [size][width]: the same by columns, the first one next to the diagonal
  std::vector<double> diagonal_;  // [size]: 1 / D of A = L D L^T
};

}  // namespace omentum::physics
