// Notices a time integration that diverges, by the energy that it made out of nothing.
#pragma once

#include "physics/dynamics/explicit_step.h"

namespace omentum::physics {

/// Keeps account of the energy that a body may have: what it had, and the work that was done on it since.
/// What damping or a cut took is written off within seconds, so that no store builds up behind which a
/// divergence could grow. One thread's; nothing allocates.
///
///     EnergyWatch watch(energy_margin(scheme, dt / stable), slack);
///     watch.add_work(stepper.step(law, external, dt, state));                        // each step
///     if (!watch.accepts(kinetic_energy(inertia, state.v) + law.energy(state.u), elapsed)) ...  // before it
///     is shown
class EnergyWatch {
 public:
  /// `margin`: how many times its account the energy of a sound integration may reach. `slack_j`: what passes
  /// in any case, far above rounding.
  EnergyWatch(double margin, double slack_j) : margin_(margin), slack_j_(slack_j) {}

  /// A new account: the energy is what it is (at the start, after a reset).
  void restart(double energy_j) noexcept;

  /// Work on the body, J: of external forces and of supports that were moved; negative where it gave some
  /// back.
  void add_work(double work_j) noexcept;

  /// False where the energy is above margin times the account's recent peak plus slack, or no number.
  /// `elapsed_s`: simulated time since the last call.
  [[nodiscard]] bool accepts(double energy_j, double elapsed_s) noexcept;

  double account_j() const { return account_j_; }

 private:
  double margin_, slack_j_;
  double account_j_ = 0;
  double peak_j_ = 0;  // a body on its way back has given up its work before its energy
};

/// The margin of a step that is `share` < 1 of the stable one. Symplectic Euler keeps E + dt v . f / 2
/// instead of E, which is between (1 - share) and (1 + share) times E in its fastest mode; the others shrink
/// but for what damping shifts between u and v within a swing.
double energy_margin(ExplicitScheme scheme, double share);

}  // namespace omentum::physics
