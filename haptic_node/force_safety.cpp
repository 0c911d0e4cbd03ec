#include "haptic_node/force_safety.h"

#include "haptic_node/tool_kinematics.h"
#include "transport/messages.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

// Poses that a device may be late by before it counts as silent.
constexpr double kStaleIntervals = 2.5;
// A stall is no reason to step: a tick counts for at most so many nominal periods of slew.
constexpr double kSlewPeriods = 2;

bool shorten(Vec3& v, double limit) {
  const double length = v.norm();
  if (length <= limit) return false;
  v *= limit / length;
  return true;
}

bool approach(Vec3& target, const Vec3& from, double limit) {
  Vec3 change = target - from;
  if (!shorten(change, limit)) return false;
  target = from + change;
  return true;
}

}  // namespace

bool clamp_wrench(Wrench& wrench, double max_force_n, double max_torque_nm) noexcept {
  const bool force = shorten(wrench.force, max_force_n), torque = shorten(wrench.torque, max_torque_nm);
  return force || torque;
}

bool slew_wrench(Wrench& wrench, const Wrench& before, const ForceLimits& limits, double dt_s) noexcept {
  const double step_n = limits.max_slew_n_s * dt_s;
  const bool force = approach(wrench.force, before.force, step_n);
  const bool torque =
      approach(wrench.torque, before.torque, step_n * limits.max_torque_nm / limits.max_force_n);
  return force || torque;
}

double fade(double gain, bool fresh, const ForceLimits& limits, double dt_s) noexcept {
  return fresh ? std::min(1.0, gain + dt_s / limits.ramp_s) : std::max(0.0, gain - dt_s / limits.decay_s);
}

double stale_after(double pose_interval_s, const ForceLimits& limits) noexcept {
  const double longest_s = std::max(limits.stale_s, kLongestStale_s);
  return std::clamp(kStaleIntervals * pose_interval_s, limits.stale_s, longest_s);
}

void ForceSafety::clear_fault() noexcept {
  faulted_ = false;
  restart();
}

void ForceSafety::restart() noexcept {
  gain_ = 0;
  passivity_.restart();
}

// What the hand did since the last tick, under the force that was written last.
void ForceSafety::follow(const SafetyInput& input) noexcept {
  if (input.written) acting_ = passed_;
  if (!known_place_ || input.reconnected) {
    velocity_.setZero();
  } else {
    const Vec3 way = input.tip - tip_;
    if (input.way_s > 0) {
      way_s_ = input.way_s;
      velocity_ = way / way_s_;
    }
    passivity_.observe(acting_, way, rotation_between(orientation_, input.orientation), input.stored_j,
                       input.dt_s);
  }
  known_place_ = input.engaged;
  tip_ = input.tip;
  orientation_ = input.orientation;
}

void ForceSafety::fade_to(const SafetyInput& input, std::uint32_t& state) noexcept {
  if (input.reconnected) gain_ = 0;
  const double stale_s = stale_after(input.pose_interval_s, limits_);
  const bool fresh = input.engaged && input.pose_age_s <= stale_s;
  gain_ = fade(gain_, fresh && !input.paused, limits_, input.dt_s);
  // a tick that came late must not stretch the decay
  const double spent = (input.pose_age_s - stale_s) / limits_.decay_s;
  if (!fresh) gain_ = input.engaged ? std::clamp(1 - spent, 0.0, gain_) : 0;
  if (!fresh) state |= msg::FORCE_STALE;
  if (input.paused) {
    state |= msg::FORCE_PAUSED;
  } else if (fresh && gain_ < 1) {
    state |= msg::FORCE_RAMP;
  }
  // what comes after a pause is a new account
  if (input.paused && gain_ == 0) passivity_.restart();
}

Wrench ForceSafety::filter(const SafetyInput& input, std::uint32_t& state) noexcept {
  const double share = passivity_.model_share();
  Wrench wrench{gain_ * share * input.model.force, gain_ * share * input.model.torque};
  const Vec3 damping = passivity_.damping(velocity_, way_s_);
  if (gain_ > 0 && (share < 1 || !damping.isZero(0))) {
    wrench.force += gain_ * damping;
    state |= msg::FORCE_PASSIVITY;
  }
  limit(input, wrench, state);
  return wrench;
}

void ForceSafety::limit(const SafetyInput& input, Wrench& wrench, std::uint32_t& state) const noexcept {
  drop_unactuated(wrench, device_.actuated_axes, input.orientation);
  const double max_force_n = std::min(device_.max_force_n, limits_.max_force_n);
  const double max_torque_nm = std::min(device_.max_torque_nm, limits_.max_torque_nm);
  if (clamp_wrench(wrench, max_force_n, max_torque_nm)) state |= msg::FORCE_CLAMPED;
  const double slew_s = std::min(input.dt_s, kSlewPeriods * limits_.period_s);
  if (slew_wrench(wrench, passed_, limits_, slew_s)) state |= msg::FORCE_SLEW;
  // the decay binds what leaves, the slew limit included
  if (state & (msg::FORCE_STALE | msg::FORCE_PAUSED))
    clamp_wrench(wrench, gain_ * max_force_n, gain_ * max_torque_nm);
}

SafeForce ForceSafety::pass(const SafetyInput& input) noexcept {
  SafeForce out;
  const bool readable = is_finite(input.model) && input.tip.allFinite() &&
                        input.orientation.coeffs().allFinite() && std::isfinite(input.dt_s) &&
                        input.dt_s >= 0 && std::isfinite(input.pose_age_s);
  if (!readable) faulted_ = true;
  if (readable) {
    follow(input);
    fade_to(input, out.state);
  }
  if (!faulted_) out.wrench = filter(input, out.state);
  if (!is_finite(out.wrench)) faulted_ = true;
  if (faulted_) {
    restart();
    out = {Wrench{}, out.state | msg::FORCE_FAULT};
  }
  passed_ = out.wrench;
  return out;
}

}  // namespace omentum::haptic
