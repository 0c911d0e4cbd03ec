// The one exit of every force (DESIGN 4): whatever the model says, what leaves here is finite, limited,
// smooth, young and passive.
#pragma once

#include "geometry/types.h"

#include <Eigen/Geometry>

#include <cstdint>

namespace omentum::haptic {

using geometry::Vec3;

struct Wrench {
  Vec3 force = Vec3::Zero();   // on the hand at the tip, in W, N
  Vec3 torque = Vec3::Zero();  // on the hand about the tip, in W, N m
};

bool is_finite(const Wrench& wrench) noexcept;

/// The scene's limits, and the device's once DeviceInfo came: the smaller one counts.
struct ForceLimits {
  double max_force_n = 10;
  double max_torque_nm = 0.5;
  double max_slew_n_s = 2000;
  double ramp_s = 0.2;
  double stale_s = 0.005;
  double decay_s = 0.02;
};

// ---- pure filters
// -----------------------------------------------------------------------------------------------

/// Shortens force and torque to their limits, direction kept. Returns whether it did.
bool clamp_wrench(Wrench& wrench, double max_force_n, double max_torque_nm) noexcept;

/// Limits the change from `before` in dt, force and torque each as a vector: a straight line towards the
/// target. Torque slews with the force's limit times the ratio of both limits. Returns whether it did.
bool slew_wrench(Wrench& wrench, const Wrench& before, const ForceLimits& limits, double dt_s) noexcept;

/// The fading factor in 0..1: up by dt/ramp while poses are fresh, down by dt/decay while they are stale.
double fade(double gain, bool fresh, const ForceLimits& limits, double dt_s) noexcept;

/// Time-domain passivity (Hannaford and Ryu 2002): what the hand put in, less what it got back, over the
/// force that was sent and the way it went. Energy below zero came from nowhere: it is taken out again by
/// damping the hand.
class PassivityObserver {
 public:
  /// Energy that may be given before anything is damped, J. The sampled contact gives a few 0.1 mJ in a
  /// press, and a mesh leaves ripples: pressing on a node and letting go on a face is a little cycle. 5 mJ
  /// lifts a 50 g handle by a centimetre: nobody is pushed by it.
  static constexpr double kReserve_j = 5e-3;
  /// The reserve comes back at this rate, W: far below what a hand dissipates, and below an oscillation that
  /// is felt (0.5 N, 0.5 mm, 10 Hz: 8 mW).
  static constexpr double kRefill_w = 2e-3;
  /// The strongest damping, N s/m: what a light handle bears at 300 Hz without trembling.
  static constexpr double kMaxDamping_n_s_m = 15;

  /// A tick in which the tip went by `way` while `sent` acted. `stored_j`: elastic energy that the contacts
  /// hold now; nobody may have more in hand than that and the reserve.
  void observe(const Wrench& sent, const Vec3& way, const Vec3& turn, double stored_j, double dt_s) noexcept;

  /// The damping force that takes the deficit out in one tick at this speed; zero while there is none.
  Vec3 damping(const Vec3& velocity, double dt_s) const noexcept;

  void restart() noexcept { energy_j_ = kReserve_j; }
  double energy_j() const noexcept { return energy_j_; }
  /// Energy that was given to the hand in all, less what it put in, J.
  double given_j() const noexcept { return given_j_; }

 private:
  double energy_j_ = kReserve_j;
  double given_j_ = 0;
};

// ---- the exit
// ---------------------------------------------------------------------------------------------------

/// What safety knows about one tool in this tick.
struct SafetyInput {
  Wrench model;  // what the step answers
  double stored_j = 0;
  Vec3 tip = Vec3::Zero();  // p_WT of the newest pose
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  double pose_age_s = 0;     // since the newest accepted pose arrived
  double dt_s = 0;           // since the last tick
  bool engaged = false;      // a pose was ever accepted
  bool reconnected = false;  // the newest pose is a new connection
  bool paused = false;
};

struct SafeForce {
  Wrench wrench;
  std::uint32_t state = 0;  // msg::FORCE_* bits; 0: exactly the model's
};

/// One tool's exit. Time base: the age of the pose on the haptic node's own clock, and the ticks' dt; both
/// are given. One thread.
class ForceSafety {
 public:
  explicit ForceSafety(const ForceLimits& limits) : limits_(limits) {}

  /// DeviceInfo: from now on the smaller of both limits. Not positive: the device has no such limit.
  void set_device_limits(double max_force_n, double max_torque_nm) noexcept;

  SafeForce pass(const SafetyInput& input) noexcept;

  /// A latched fault holds the force at zero until a person clears it; then it fades in.
  bool faulted() const noexcept { return faulted_; }
  void clear_fault() noexcept;
  /// The next force fades in from zero.
  void restart() noexcept;

  const PassivityObserver& passivity() const noexcept { return passivity_; }

 private:
  Wrench filter(const SafetyInput& input, std::uint32_t& state) noexcept;
  void fade_to(const SafetyInput& input, std::uint32_t& state) noexcept;
  void follow(const SafetyInput& input) noexcept;

  ForceLimits limits_;
  double device_force_n_ = 0, device_torque_nm_ = 0;  // 0: unknown
  PassivityObserver passivity_;
  Wrench sent_;
  double gain_ = 0;
  bool faulted_ = false;
  bool known_place_ = false;
  Vec3 tip_ = Vec3::Zero(), velocity_ = Vec3::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
};

}  // namespace omentum::haptic
