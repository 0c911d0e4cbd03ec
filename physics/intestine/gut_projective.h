// An implicit step for the springs of an intestine with a matrix that never changes.
#pragma once

#include "physics/intestine/gut_band.h"
#include "physics/intestine/gut_forces.h"
#include "physics/intestine/gut_state.h"

namespace omentum::physics {

/// Backward Euler: x' with M ((1 + dt drag)(x' - x) / dt^2 - v / dt) = f(x') + f_ext and v' = (x' - x) / dt,
/// approached by a fixed number of steps downhill with the constant matrix of GutBand from x + dt v on
/// (projective dynamics, Bouaziz et al. 2014, as the quasi-Newton method that it is). Where the forces
/// balance it stays, whatever the number of iterations: rest depends neither on it nor on dt.
class GutProjective {
 public:
  /// `springs` and `band`, which was made with the same step, outlive it.
  GutProjective(const GutSprings& springs, const GutBand& band, double step_s, int iterations);

  /// One step under `forces_n`, [masses], N. Nothing of this class allocates.
  void step(std::span<const geometry::Vec3> forces_n, GutState& state) noexcept;

  /// The same piece by piece, for who comes between the iterations: begin() puts x where they begin, each
  /// go_downhill() takes x on, under `pushes_n`, [masses], N, beside the forces, and end() sets v for where x
  /// is then, under these pushes.
  void begin(std::span<const geometry::Vec3> forces_n, GutState& state) noexcept;
  void go_downhill(std::span<const geometry::Vec3> pushes_n, std::span<geometry::Vec3> x) noexcept;
  void end(std::span<const geometry::Vec3> pushes_n, std::span<const geometry::Vec3> x,
           std::span<geometry::Vec3> v) noexcept;
  int iterations() const { return iterations_; }

 private:
  void go_downhill() noexcept;
  void find_residual() noexcept;
  void keep_energy(std::span<const geometry::Vec3> pushes_n, std::span<const geometry::Vec3> x,
                   std::span<geometry::Vec3> v) noexcept;

  const GutSprings& springs_;
  const GutBand& band_;
  double step_s_;
  int iterations_;
  GutForces forces_;
  double energy_j_ = 0;                // at the start of the step
  std::vector<double> inertia_;        // [masses] M (1 + dt drag) / dt^2, N/m
  std::vector<std::int32_t> mass_;     // [free masses] of the band, in its order
  std::vector<geometry::Vec3> start_;  // [masses] x at the start of the step
  std::vector<geometry::Vec3> loads_;  // [masses] N, of the step
  GutPlanes x_, constant_, f_;         // [masses] x'; what does not change in a step, and all that is left, N
  std::vector<GutBand::Node> way_;     // [free masses] N, then m
};

}  // namespace omentum::physics
