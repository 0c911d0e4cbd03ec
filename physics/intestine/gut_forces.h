// The springs of an intestine as loops for vector units.
#pragma once

#include "physics/intestine/gut_planes.h"
#include "physics/intestine/gut_springs.h"

namespace omentum::physics {

/// What GutSprings::forces and energy say, fast. Keeps room for each spring: one thread at a time. Nothing
/// allocates after construction.
class GutForces {
 public:
  /// `springs` outlives it.
  explicit GutForces(const GutSprings& springs);

  /// E, J, at `x`; keeps how long the springs are there.
  double measure(GutPlanes& x) noexcept;

  /// From here on add_implicit has the damping of a step of `step_s` from where the springs were last
  /// measured.
  void begin_step(double step_s) noexcept;
  /// f += the forces at x, N, damping k tau (l - l of the step's start) / dt included.
  void add_implicit(GutPlanes& x, GutPlanes& f) const noexcept;

  /// f += the forces at x, N, with damping by velocities.
  void add_explicit(GutPlanes& x, GutPlanes& v, GutPlanes& f) const noexcept;

 private:
  template <class Run>
  struct Loop {
    explicit Loop(const Run& what) : run(what), length(what.count), pull(what.count) {}
    Run run;
    std::vector<double> length, pull;  // [count] m, N
  };
  template <class Work>
  void each(const Work& work) {
    for (auto& loop : springs_) work(loop);
    work(bends_);
  }
  template <class Work>
  void each(const Work& work) const {
    for (const auto& loop : springs_) work(loop);
    work(bends_);
  }

  double tau_s_;
  double damping_ = 0;  // tau / dt
  std::vector<Loop<kernels::SpringRun>> springs_;
  Loop<kernels::BendRun> bends_;
};

}  // namespace omentum::physics
