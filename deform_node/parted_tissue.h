// Which pieces of an organ without masses, or with some in a part, supports no longer hold, and that they
// have masses from then on.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/unheld_pieces.h"

namespace omentum::deform {

/// Books of an organ that is cut where it is in equilibrium. Takes its memory when it is made; one thread.
class PartedTissue {
 public:
  /// `mesh` outlives it; `fixed`: its supports, [N]; `massless`: [T] other than 0, what has nodes without
  /// masses; empty: all has.
  PartedTissue(const geometry::TetraMesh& mesh, const physics::FixedComponents& fixed,
               std::vector<std::uint8_t> massless = {});

  /// Of what other organs meet of such an organ: a wall that moves, but for pieces where these `fall`.
  static physics::Inertia met(physics::Inertia inertia, bool fall);

  /// Of a body that is let go: a support that holds a piece by a node or an edge alone lets go of it, or it
  /// would swing on slivers that no step is exact for.
  static physics::Inertia without_supports(physics::Inertia inertia);

  /// All tetrahedra of pieces that nothing holds (physics/unheld_pieces.h), in which some are massless, and
  /// that were not let go before; valid until the next call. O(T).
  std::span<const geometry::TetId> find(const geometry::MeshEditor& editor) noexcept;
  /// Those of such pieces that a support touches; valid until the next call.
  std::span<const geometry::TetId> on_supports(std::span<const geometry::TetId> pieces) noexcept;
  /// They have masses (BodyStepper::let_go) where they had none, `mass`, [N], kg. There `v`, [3N], says that
  /// they are at rest: from one equilibrium to the next is no motion.
  void let_go(std::span<const geometry::TetId> tetrahedra, std::span<const double> mass,
              std::span<double> v) noexcept;
  void restore() noexcept;
  bool any() const noexcept { return any_; }

 private:
  const geometry::TetraMesh& mesh_;
  physics::FixedComponents fixed_;
  physics::UnheldPieces unheld_;
  std::vector<std::uint8_t> massless_;         // [T] or empty
  std::vector<bool> is_let_go_;                // [T]
  std::vector<geometry::TetId> found_, tied_;  // capacity T
  bool any_ = false;
};

}  // namespace omentum::deform
