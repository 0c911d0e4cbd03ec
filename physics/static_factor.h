// The factor of a body's static stiffness, kept while tetrahedra are removed: what a precomputed organ
// answers after a cut.
#pragma once

#include "physics/dynamics/kept_factor.h"
#include "physics/parting.h"

namespace omentum::physics {

/// K over the free degrees of freedom, factorized once and downdated by six ranks per removed tetrahedron
/// (KeptFactor without masses): u = K^-1 f is equilibrium, and any block of K^-1 the compliance that force
/// tensors would have if they were computed anew of the cut mesh (Cotin 1999, section 4). What the rest no
/// longer holds would make K singular, and a factorization may not notice: it is found by topology before.
/// Nodes that lose their last tetrahedron are anchored, each by a spring to where it is, and so is a part
/// that goes as a whole (physics/parting.h): the rest is exact.
///
/// All memory is taken at construction; one thread at a time. Vectors are [3N], as KeptFactor's.
class StaticFactor {
 public:
  /// Throws FloatingError where the supports do not hold the body, std::runtime_error when memory runs out.
  /// `mesh`: checked, outlives it.
  StaticFactor(const geometry::TetraMesh& mesh, const MaterialMap& material, const FixedComponents& fixed,
               int most_compliance_nodes = 24);

  /// Takes tetrahedra off. Preconditions: each is there; what is left is held (UnheldPieces), by supports or
  /// by hold(). False: it hangs together so loosely that nothing is known to working precision; to be
  /// answered with restore().
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept;
  /// Anchors nodes; they differ, and none is anchored already.
  [[nodiscard]] bool hold(std::span<const geometry::NodeId> nodes) noexcept;
  /// As constructed.
  void restore() noexcept;

  /// u = K^-1 f of what is left, m of N; nodes that lost everything answer as their anchors do.
  void solve(std::span<const double> f, std::span<double> u) noexcept { kept_.solve(f, u); }
  /// The same to rounding, for twice the work: residuals are taken in double, and K need not be far from
  /// singular.
  void solve_exactly(std::span<const double> f, std::span<double> u) noexcept;
  /// f = K u, without anchors, N.
  void holding_forces(std::span<const double> u, std::span<double> f) const noexcept {
    kept_.holding_forces(u, f);
  }
  /// The rows and columns of K^-1 that belong to `nodes`, [3n x 3n], symmetric, m/N; as
  /// KeptFactor::inverse_block.
  void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept {
    kept_.inverse_block(nodes, block);
  }

  /// What an anchor answers, in each direction, N/m: a mean of K's diagonal.
  double anchor_n_m() const { return anchor_n_m_; }
  std::int32_t node_count() const { return kept_.node_count(); }
  /// Entries of the factor.
  std::size_t entry_count() const { return kept_.entry_count(); }
  /// Whether a support holds component `c` of the [3N].
  bool is_held(std::size_t c) const { return kept_.is_held(c); }

 private:
  Parting parting_;
  double anchor_n_m_;
  KeptFactor kept_;
  std::vector<double> residual_, correction_;  // [3N]
};

}  // namespace omentum::physics
