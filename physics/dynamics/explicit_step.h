// Time integration without any equation to solve: forward Euler, symplectic Euler and Runge-Kutta 4.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/dynamics/force_law.h"

#include <array>

namespace omentum::physics {

enum class ExplicitScheme {
  kForwardEuler,     // u' = u + dt v, v' = v + dt a(u, v): without damping it gains energy at any step
  kSymplecticEuler,  // v' = v + dt a(u, v'), u' = u + dt v': keeps energy at one force a step
  kRungeKutta4,      // four forces a step; loses energy of the fastest modes
};

inline constexpr std::array kExplicitSchemes{ExplicitScheme::kForwardEuler, ExplicitScheme::kSymplecticEuler,
                                             ExplicitScheme::kRungeKutta4};

/// "forward-euler", "symplectic-euler", "rk4".
const char* name_of(ExplicitScheme scheme);

/// M a = f(u + b v) - a M v + f_ext over the free components, with Rayleigh's a and b of the inertia: the
/// force is asked for ahead of the displacement by b v, which is stiffness-proportional damping -b K v
/// without a second evaluation (exactly so for a linear law). In symplectic Euler a is implicit and limits no
/// step. Held components keep their displacement, whatever it is, and have no velocity.
class ExplicitStep {
 public:
  /// `inertia` outlives it. Allocates what steps need.
  ExplicitStep(ExplicitScheme scheme, const Inertia& inertia);

  /// One step of `dt_s`; `external_n`: [3 N] forces on the nodes, held through the step. Returns the work
  /// they did, J. Stability is the caller's to see to (stable_step.h, energy_watch.h). Allocates nothing.
  [[nodiscard]] double step(ForceLaw& law, std::span<const double> external_n, double dt_s,
                            BodyState& state) noexcept;

 private:
  // a_ of displacements and velocities, drag left out where the scheme has it implicit
  void accelerate(ForceLaw& law, std::span<const double> external_n, const std::vector<double>& u,
                  const std::vector<double>& v, double drag_per_s) noexcept;
  double forward_euler(ForceLaw& law, std::span<const double> external_n, double dt,
                       BodyState& state) noexcept;
  double symplectic_euler(ForceLaw& law, std::span<const double> external_n, double dt,
                          BodyState& state) noexcept;
  double runge_kutta(ForceLaw& law, std::span<const double> external_n, double dt, BodyState& state) noexcept;

  ExplicitScheme scheme_;
  const Inertia& inertia_;
  std::vector<double> inverse_mass_;                           // [3N], 1/kg; 0 where held
  std::vector<double> ahead_, a_;                              // [3N]
  std::vector<double> u_stage_, v_stage_, u_slope_, v_slope_;  // [3N], Runge-Kutta's
};

}  // namespace omentum::physics
