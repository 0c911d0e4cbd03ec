// Notices a time integration that diverges, by the energy it made out of nothing.
#pragma once

namespace omentum::physics {

/// Keeps account of the energy that a body may have: what it had, and the work that was done on it since. What
/// damping takes is written off at leisure, so that no store of it builds up behind which a divergence could grow
/// for long. One thread's; nothing allocates.
///
///     EnergyWatch watch(energy_margin(scheme, dt / stable_step_s(...)));
///     ...                                     // after each step
///     watch.add_work(stepper.step(...));
///     ...                                     // now and then, before the state is shown to anyone
///     if (!watch.accepts(kinetic_energy(inertia, state.v) + law.energy(state.u), elapsed_s)) go_back_to_rest();
class EnergyWatch {
 public:
  /// `margin`: how many times its account a sound integration's energy may reach. `slack_j`: what passes in any
  /// case, above all rounding.
  EnergyWatch(double margin, double slack_j);

  /// A new account: the energy is what it is (start, reset, restored state).
  void restart(double energy_j) noexcept { account_j_ = energy_j; }

  /// Work on the body: of external forces, of supports that were moved (negative where it gave some back).
  void add_work(double work_j) noexcept { account_j_ += work_j; }

  /// Energy that left with what was removed, in one go.
  void take(double energy_j) noexcept { account_j_ -= energy_j; }

  /// False where the energy is above margin times account plus slack, or no number. `elapsed_s`: simulated time
  /// since the last call.
  [[nodiscard]] bool accepts(double energy_j, double elapsed_s) noexcept;

  double account_j() const { return account_j_; }

 private:
  double margin_, slack_j_;
  double account_j_ = 0;
};

}  // namespace omentum::physics
