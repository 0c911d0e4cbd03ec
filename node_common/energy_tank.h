// How much energy a force may still give to a hand. Both ends of a tool's line keep such an account:
// haptic_node of what it believes, the device of what it exerted.
#pragma once

#include <Eigen/Core>

namespace omentum::node {

/// How a hand moves, as far as it was seen.
struct HandMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   // of the tip in W on the newest way, m/s
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  // in W, rad/s
  double grip_rate = 0;                                 // at which the jaws open, rad/s
  // as fast as it was a moment ago: a hand that turns to and fro between two looks seems to stand still
  double speed = 0, turn_speed = 0, grip_speed = 0;  // m/s, rad/s
  int steady = 0;                                    // ways in a row on which the tip did not turn back

  /// It went this way (m; rad, in W) in took_s > 0, and opened its jaws by `opened_rad`.
  void follow(const Eigen::Vector3d& way, const Eigen::Vector3d& turn, double took_s,
              double opened_rad = 0) noexcept;
};

/// The most work that force (N), torque (N m) and the jaws' torque (N m) can do on a hand within `horizon_s`,
/// J: it may turn round at its speed, and speed up as fast as hands do.
///
///     W = |f| (|v| h + a h^2 / 2) + |t| (|w| h + b h^2 / 2) + |t_g| (|g'| h + b h^2 / 2)
double work_ahead_j(const Eigen::Vector3d& force, const Eigen::Vector3d& torque, const HandMotion& motion,
                    double horizon_s, double grip_torque_nm = 0) noexcept;

/// An energy tank (Duindam and Stramigioli 2004; Franken et al. 2011): what the hand put in and a small
/// reserve, less what it got. A wrench is let through as far as the tank covers its work_ahead_j, so that the
/// tank is not overdrawn rather than refilled afterwards. It never holds more than the reserve and what the
/// tissue stores: what the hand lost by friction cannot push it later.
///
/// Over its whole life the tank gives at most kBound_j more than the hand put in. No restart, pause or
/// reconnection fills it: the reserve comes back from what the hand puts in, and a debt is never forgotten.
/// Plain arithmetic; reads no clock. One thread.
class EnergyTank {
 public:
  /// The promise, J: 10 mJ lift a 100 g handle by a centimetre. Nobody is pushed by it.
  static constexpr double kBound_j = 10e-3;
  /// What the tank begins with, J. A sampled contact gives a few 0.1 mJ in a press. The rest of the bound is
  /// for hands that turn faster than work_ahead_j thinks: 10 N times 0.5 m/s for a millisecond.
  static constexpr double kReserve_j = 5e-3;
  /// The reserve comes back at this rate, W, out of what the hand lost besides: below an oscillation that is
  /// felt (0.5 N, 0.5 mm, 10 Hz: 8 mW).
  static constexpr double kRefill_w = 2e-3;
  /// Below this level the hand is damped, J: with nothing in the tank a slow press would never begin to be
  /// felt. 1 mJ covers 10 N at 5 cm/s for two milliseconds.
  static constexpr double kLow_j = 1e-3;
  /// The strongest damping, N s/m: what a light handle bears without trembling at 300 Hz ...
  static constexpr double kMaxDamping_n_s_m = 15;
  /// ... where a sampled damper trembles when it stops this mass within one sample, kg ...
  static constexpr double kLightHandle_kg = 0.05;
  /// ... reached at this much below kLow_j, J; the weakest, so that a debt comes to an end; and the largest
  /// force of it, N: a hand that moves fast is braked, not stopped.
  static constexpr double kFullDamping_j = 5e-3, kLeastDamping_n_s_m = 1, kMostDamping_n = 2;
  /// A damper feeds a hand that turns round before it is seen to. So it acts on one that has gone on for so
  /// many ways, and where it is wrong all the same it gives at most this share of what is left of the bound,
  /// less a little, J.
  static constexpr int kSteadyWays = 5;
  static constexpr double kDamperRisk = 0.1, kDamperMargin_j = 0.5e-3;
  /// Where nothing is left (a loop stood still under a force) it may try with this, W, 0.4 mJ in an hour, and
  /// with what the hand then puts in, up to this, J: or no debt could ever be paid.
  static constexpr double kTrial_w = 0.1e-6, kMostTrial_j = 0.5e-3;

  /// Time went by in which the hand was given `given_j` (negative: it put in), J; `stored_j`: elastic energy
  /// that the tissue holds now, as far as it is believed.
  void observe(double given_j, double stored_j, double dt_s) noexcept;

  /// The share, 0..1, of a wrench that may leave: `ahead_j` is its work_ahead_j.
  double share(double ahead_j) const noexcept;

  /// The force that takes a debt out of a moving hand, N; zero from kLow_j on. `interval_s`: until it can
  /// next be changed.
  Eigen::Vector3d damping(const HandMotion& motion, double interval_s) const noexcept;

  double level_j() const noexcept { return level_j_; }
  /// What the hand was given in all, less what it put in, J.
  double given_j() const noexcept { return given_j_; }

 private:
  double level_j_ = kReserve_j;
  double given_j_ = 0;
  double trial_j_ = 0;
};

}  // namespace omentum::node
