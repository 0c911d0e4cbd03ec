// The account of the energy that a hand was given: what came from nowhere is taken out again.
#pragma once

#include "haptic_node/wrench.h"

namespace omentum::haptic {

/// Time-domain passivity (Hannaford and Ryu 2002): what the hand put in, less what it got back, over the
/// force that was sent and the way it went. Energy below zero came from nowhere: it is taken out again by
/// damping the hand. What a damper that the hand bears cannot take out is cut off at the source: from
/// kTolerated_j on the model's wrench is scaled down, and none is left from kSilent_j on.
///
/// The energy that a hand is given is thereby bounded, whatever the model does: at most kSilent_j, what flows
/// while the last wrench slews to zero, and kRefill_w with time. Scaling, unlike a latched fault, is
/// continuous, gives the force back by itself when the source ends, and needs nobody to notice it.
class PassivityObserver {
 public:
  /// Energy that may be given before anything is damped, J. The sampled contact gives a few 0.1 mJ in a
  /// press, and a mesh leaves ripples: pressing on a node and letting go on a face is a little cycle. 5 mJ
  /// lifts a 50 g handle by a centimetre: nobody is pushed by it.
  static constexpr double kReserve_j = 5e-3;
  /// The reserve comes back at this rate, W: far below what a hand dissipates, and below an oscillation that
  /// is felt (0.5 N, 0.5 mm, 10 Hz: 8 mW).
  static constexpr double kRefill_w = 2e-3;
  /// The strongest damping, N s/m: what a light handle bears without trembling at 300 Hz ...
  static constexpr double kMaxDamping_n_s_m = 15;
  /// ... where a sampled damper trembles when it stops this mass within one sample, kg.
  static constexpr double kLightHandle_kg = 0.05;
  /// A deficit that damping alone repays, J: twice the reserve. The hand must move for it: at 5 cm/s the
  /// strongest damper takes out 37 mW.
  static constexpr double kTolerated_j = 10e-3;
  /// A deficit at which nothing of the model is left, J: four reserves, what a push of 2 N over 1 cm gives.
  static constexpr double kSilent_j = 20e-3;
  /// The account's floor, J: 10 N that slew to zero in 5 ms along a hand of 1 m/s give 25 mJ beyond the point
  /// of silence, and these still count. Nothing beyond is remembered: the hand would feel mud for minutes.
  static constexpr double kFloor_j = -50e-3;

  /// A tick in which the tip went by `way` while `sent` acted. `stored_j`: elastic energy that the contacts
  /// hold now; nobody may have more in hand than that and the reserve.
  void observe(const Wrench& sent, const Vec3& way, const Vec3& turn, double stored_j, double dt_s) noexcept;

  /// The damping force that takes the deficit out until the next pose comes, `interval_s` from now, at this
  /// speed; zero while there is none.
  Vec3 damping(const Vec3& velocity, double interval_s) const noexcept;

  /// The share of the model's wrench that may leave, 0..1.
  double model_share() const noexcept;

  void restart() noexcept { energy_j_ = kReserve_j; }
  double energy_j() const noexcept { return energy_j_; }
  /// Energy that was given to the hand in all, less what it put in, J.
  double given_j() const noexcept { return given_j_; }

 private:
  double energy_j_ = kReserve_j;
  double given_j_ = 0;
};

}  // namespace omentum::haptic
