// An implicit step for the springs of an intestine with a matrix that never changes.
#pragma once

#include "physics/intestine/gut_band.h"
#include "physics/intestine/gut_state.h"

namespace omentum::physics {

/// Backward Euler: x' with M ((1 + dt drag)(x' - x) / dt^2 - v / dt) = f(x') + f_ext and v' = (x' - x) / dt,
/// approached by a fixed number of steps downhill with the constant matrix of GutBand from x + dt v on.
/// Where the forces balance it stays whatever the number of iterations: rest does not depend on it, nor on
/// dt.
class GutProjective {
 public:
  /// `springs` and `band`, which was made with the same step, outlive it.
  GutProjective(const GutSprings& springs, const GutBand& band, double step_s, int iterations);

  /// One step under `forces_n`, [masses], N. Allocates nothing.
  void step(std::span<const geometry::Vec3> forces_n, GutState& state) noexcept;

 private:
  void downhill(std::span<const geometry::Vec3> forces_n, const std::vector<geometry::Vec3>& v,
                std::vector<geometry::Vec3>& x) noexcept;

  const GutSprings& springs_;
  const GutBand& band_;
  double step_s_;
  int iterations_;
  std::vector<geometry::Vec3> start_, v_, f_;  // [masses]: x of the step's start, (x' - x) / dt, springs' N
  std::vector<GutBand::Node> solved_;          // [free masses]
};

}  // namespace omentum::physics
