// Symplectic Euler for the springs of an intestine.
#pragma once

#include "physics/intestine/gut_forces.h"
#include "physics/intestine/gut_state.h"

namespace omentum::physics {

/// v' = (v + dt a(x, v)) / (1 + dt drag), x' = x + dt v' for the masses that are free.
class GutExplicit {
 public:
  /// `springs` outlives it. Throws std::invalid_argument when `step_s` is above stable_step_s.
  GutExplicit(const GutSprings& springs, double step_s);

  /// One step under `forces_n`, [masses], N. Allocates nothing.
  void step(std::span<const geometry::Vec3> forces_n, GutState& state) noexcept;

 private:
  const GutSprings& springs_;
  double step_s_;
  GutForces forces_;
  GutPlanes x_, v_, f_;  // [masses]
};

/// The largest step, s, at which no mode of the springs grows: from a bound of the fastest frequency w that
/// holds for every shape, and the damping of the springs tau: dt (tau w^2 + dt w^2 / 2) <= 2.
double stable_step_s(const GutSprings& springs);

}  // namespace omentum::physics
