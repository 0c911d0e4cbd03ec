// The one exit of every force (docs/design.md, "Force safety"): whatever the model says, what leaves here is
// finite, limited, smooth, young and passive.
#pragma once

#include "haptic_node/acting_force.h"
#include "haptic_node/device_limits.h"
#include "node_common/energy_tank.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

namespace omentum::haptic {

/// The scene's limits, and the loop's pace. Where a device has a limit too, the smaller one counts.
struct ForceLimits {
  double max_force_n = 10;
  double max_torque_nm = 0.5;
  double max_slew_n_s = 2000;
  double ramp_s = 0.2;
  double stale_s = 0.005;
  double decay_s = 0.02;
  double period_s = 0.001;  // nominal, of the loop
};

/// However slow a device is, a pose older than this is stale, s: two and a half periods at 100 Hz, and a
/// tenth of what a person needs to let go.
inline constexpr double kLongestStale_s = 0.025;
/// Poses that come less often than this are stale before the next one comes: hardly a force is left, s. A
/// tenth is what the timers of a device of 40 Hz may be late by.
inline constexpr double kLongestInterval_s = 1.1 * kLongestStale_s;

// ---- pure filters
// -----------------------------------------------------------------------------------------------

/// Shortens force and torques to their limits, direction kept. Returns whether it did.
bool clamp_wrench(Wrench& wrench, double max_force_n, double max_torque_nm) noexcept;

/// Limits the change from `before` in dt, force and torque each as a vector: a straight line towards the
/// target. Torques slew with the force's limit times the ratio of both limits. Returns whether it did.
bool slew_wrench(Wrench& wrench, const Wrench& before, const ForceLimits& limits, double dt_s) noexcept;

/// The fading factor in 0..1: up by dt/ramp while poses are fresh, down by dt/decay while they are stale.
double fade(double gain, bool fresh, const ForceLimits& limits, double dt_s) noexcept;

/// After how long a pose is stale: two and a half of the device's own intervals, since one period and a half
/// is what jitter makes of a slow device, not silence; never before the scene's time, nor after
/// kLongestStale_s. `pose_interval_s` 0: not known, the scene's time holds.
double stale_after(double pose_interval_s, const ForceLimits& limits) noexcept;

// ---- the exit
// ---------------------------------------------------------------------------------------------------

/// What safety knows about one tool in this tick.
struct SafetyInput {
  Wrench model;  // what the step answers
  double stored_j = 0;
  Vec3 tip = Vec3::Zero();  // p_WT of the newest pose
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  double grip = 0;             // opening of the jaws, rad
  double pose_age_s = 0;       // since the newest accepted pose arrived
  double pose_interval_s = 0;  // how often this tool's poses come; 0: not known
  double way_s = 0;            // what the way from the last pose to a new one took; 0: no new pose
  double dt_s = 0;             // since the last tick
  bool written = true;         // what the last pass() returned was written, as far as the writer knows
  bool engaged = false;        // a tool is there
  bool reconnected = false;    // it appears: a new connection, or after a silence
  bool paused = false;
};

struct SafeForce {
  Wrench wrench;
  std::uint32_t state = 0;  // msg::FORCE_* bits; 0: exactly the model's, on driven axes
};

/// One tool's exit. Time base: the age of the pose on the haptic node's own clock, and the ticks' dt; both
/// are given. One thread.
class ForceSafety {
 public:
  explicit ForceSafety(const ForceLimits& limits) : limits_(limits), acting_(limits.decay_s) {
    set_device({});
  }

  /// DeviceInfo: from now on the smaller of both limits, on the axes that the device drives.
  void set_device(const DeviceLimits& device) noexcept;

  /// Every tick. Pauses and stale poses let the force decay to zero within decay_s.
  SafeForce pass(const SafetyInput& input) noexcept;

  /// A latched fault holds the force at zero until a person clears it; then it fades in.
  bool faulted() const noexcept { return faulted_; }
  void clear_fault() noexcept;
  /// The next force fades in from zero. The energy account goes on: a new one would be a new reserve.
  void restart() noexcept { gain_ = 0; }

  /// What the hand was given as far as this node can know: the worse of what may be.
  const node::EnergyTank& tank() const noexcept { return soon_.level_j() < late_.level_j() ? soon_ : late_; }
  /// What the model may give back to the hand without being cut, J: what the tank then holds still covers the
  /// hand as it moved last.
  double covered_j() const noexcept {
    return std::max(0.0, tank().level_j() - std::max(kKeptBack_j, ahead_j_));
  }
  static constexpr double kKeptBack_j = 1.5e-3;
  /// The share of the model's wrench that the tank let through in the last pass, 0..1.
  double share() const noexcept { return share_; }

 private:
  void follow(const SafetyInput& input) noexcept;
  void reckon(const SafetyInput& input) noexcept;
  void charge(const ActingForce::Work& given, const SafetyInput& input) noexcept;
  void fade_to(const SafetyInput& input, std::uint32_t& state) noexcept;
  Wrench filter(const SafetyInput& input, std::uint32_t& state) noexcept;
  /// How far the model's force fell at once in this tick, to which share, and what it changed by before, N.
  struct Fall {
    double share = 1, change_n = 0;
  };
  void limit(const SafetyInput& input, double slew_s, Wrench& wrench, std::uint32_t& state) const noexcept;
  Vec3 wanted_damper(const SafetyInput& input) const noexcept;
  void damp(const SafetyInput& input, const Vec3& damper, const Fall& fall, Wrench& wrench,
            std::uint32_t& state) noexcept;
  void let_go() noexcept;
  double max_force_n() const noexcept { return std::min(device_.max_force_n, limits_.max_force_n); }
  double max_torque_nm() const noexcept { return std::min(device_.max_torque_nm, limits_.max_torque_nm); }
  double interval_s(const SafetyInput& input) const noexcept;
  double slew_s(const SafetyInput& input) const noexcept { return std::min(input.dt_s, limits_.period_s); }

  ForceLimits limits_;
  DeviceLimits device_;
  ActingForce acting_;
  node::EnergyTank soon_, late_;  // for a device that turns to an answer at once, and in its next period
  Wrench passed_;                 // what the last pass() returned: ...
  Wrench model_;                  // ... the model's part of it ...
  Vec3 damping_ = Vec3::Zero();   // ... and the damper's, N
  double told_valid_s_ = 0;       // for how long it holds
  double gain_ = 0, share_ = 1;
  double ahead_j_ = 0;  // of the model's wrench in the last pass
  bool faulted_ = false;
  bool known_place_ = false;
  Vec3 tip_ = Vec3::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  double grip_ = 0;             // rad
  node::HandMotion motion_;     // on the newest way ...
  double way_s_ = 0;            // ... which took so long
  ActingForce::Work reckoned_;  // charged since the newest pose, as if the hand had gone on
};

}  // namespace omentum::haptic
