// Steps that are long against a body's own swings: what moves on, is cut and is felt by a tool.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/dynamics/yielding.h"

#include <span>

namespace omentum::physics {

/// Backward Euler on a kept factor (ImplicitStep, WarpedStep). One thread at a time; what is noexcept
/// allocates nothing. Vectors are [3N], x y z of each node in the mesh's order.
class LargeStep : public Yielding {
 public:
  /// One step under `external` forces, N. False: the result is not finite.
  [[nodiscard]] virtual bool step(BodyState& state, std::span<const double> external) noexcept = 0;
  /// The same more exactly, for a state in which step() ended with more energy than was done to it; of what
  /// is linear there is nothing more exact. False also then.
  [[nodiscard]] virtual bool step_again(BodyState& /*state*/, std::span<const double> /*external*/) noexcept {
    return false;
  }
  /// J, with what is left.
  virtual double elastic_energy(std::span<const double> u) noexcept = 0;
  /// J, of forces that were held over a step which ended with velocities `v`.
  virtual double work(std::span<const double> external, std::span<const double> v) noexcept {
    double power_w = 0;
    for (std::size_t c = 0; c < external.size(); ++c) power_w += external[c] * v[c];
    return power_w * step_s();
  }

  /// Tetrahedra go, and all come back (KeptFactor::remove and restore).
  [[nodiscard]] virtual bool remove(std::span<const geometry::TetId> tetrahedra) noexcept = 0;
  virtual void restore() noexcept = 0;
  /// What the next remove() leaves without supports, of a body part of which has no masses: it has some from
  /// now on.
  virtual void let_go(std::span<const geometry::TetId> /*tetrahedra*/) noexcept {}
  /// What each node carries now, [N], kg; zero where the step moves it without a mass.
  virtual std::span<const double> mass() const noexcept = 0;

  /// Displacement of `nodes` at the end of a step per force held over it, [3n x 3n], m/N, symmetric.
  virtual void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept = 0;
  /// Where the next step would end under `external` forces. Nothing is changed.
  virtual void foresee(const BodyState& state, std::span<const double> external,
                       std::span<double> u) noexcept = 0;
};

}  // namespace omentum::physics
