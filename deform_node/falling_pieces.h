// What was cut off an organ in equilibrium and goes on by itself: it falls, swings and turns.
#pragma once

#include "deform_node/body_stepper.h"
#include "physics/dynamics/warped_step.h"

namespace omentum::deform {

/// The nodes of these pieces move by the co-rotational law (physics/dynamics/warped_step.h) while all others
/// are in equilibrium. Its equation is of the whole body, but a piece that nothing ties to the rest is a
/// block of its own in it: what is not of a piece stays at rest in this one's states, without a force, and
/// costs a product. So pieces of any shape come at any moment, and no factor is made anew. Memory and each
/// removal cost what those of an organ with masses do; all memory is taken at construction. One thread;
/// vectors are [3N].
class FallingPieces {
 public:
  /// Throws as physics::WarpedStep does. `body.mesh` outlives it.
  FallingPieces(const SteppedBody& body, double step_s);

  bool any() const noexcept { return any_; }
  bool has(NodeId n) const noexcept { return has_node_[n]; }
  bool has(geometry::TetId t) const noexcept { return has_tetrahedron_[t]; }

  /// These fall from now on. Precondition: after the next remove() no node of theirs is of others that are
  /// left.
  void let_go(std::span<const geometry::TetId> tetrahedra) noexcept;
  /// Of any part of the body, as BodyStepper's.
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept;
  void restore() noexcept;

  /// One step of the pieces from where `state` has them, under what of `external` is theirs; to be put()
  /// where it belongs. False: it is not finite.
  [[nodiscard]] bool step(const physics::BodyState& state, std::span<const double> external) noexcept;
  const physics::BodyState& state() const noexcept { return state_; }
  double elastic_energy(std::span<const double> u) noexcept;
  /// As BodyStepper's, of the pieces; what is returned is zero elsewhere and valid until the next call.
  std::span<const double> yield_to(std::span<const double> forces, std::span<const double> guess) noexcept;
  void foresee(const physics::BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept;
  /// Overwrites what of a block over `nodes` belongs to nodes of pieces, to them alone or with others.
  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept;

  /// Copies what is of pieces, or what is not and zero elsewhere.
  void put(std::span<const double> from, std::span<double> to) const noexcept;
  void leave_out(std::span<const double> from, std::span<double> to) const noexcept;
  /// What the nodes of pieces carry now, [N], kg; others are left as they are.
  void put_mass(std::span<double> mass) const noexcept;

 private:
  void keep(std::span<const double> from, std::span<double> to) const noexcept;

  const geometry::TetraMesh& mesh_;
  physics::WarpedStep warped_;
  bool any_ = false;
  std::vector<bool> has_node_, has_tetrahedron_;  // [N], [T]
  physics::BodyState state_, here_;               // of pieces, zero elsewhere: after a step, and before it
  std::vector<double> forces_, yield_;            // [3N] likewise
  std::vector<float> block_;                      // of compliance()
};

}  // namespace omentum::deform
