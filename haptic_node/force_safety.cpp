#include "haptic_node/force_safety.h"

#include "haptic_node/tool_kinematics.h"
#include "transport/messages.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

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

bool is_finite(const Wrench& wrench) noexcept {
  return wrench.force.allFinite() && wrench.torque.allFinite();
}

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

void PassivityObserver::observe(const Wrench& sent, const Vec3& way, const Vec3& turn, double stored_j,
                                double dt_s) noexcept {
  // exact for a device that holds its force between samples
  const double given = sent.force.dot(way) + sent.torque.dot(turn);
  given_j_ += given;
  const double roof = std::max(stored_j, 0.0) + kReserve_j;
  energy_j_ = std::min(energy_j_ - given, roof);
  if (energy_j_ < kReserve_j) energy_j_ = std::min(energy_j_ + kRefill_w * dt_s, kReserve_j);
}

Vec3 PassivityObserver::damping(const Vec3& velocity, double dt_s) const noexcept {
  const double speed_squared = velocity.squaredNorm();
  if (energy_j_ >= 0 || !(speed_squared * dt_s > 0)) return Vec3::Zero();
  return -std::min(-energy_j_ / (speed_squared * dt_s), kMaxDamping_n_s_m) * velocity;
}

void ForceSafety::set_device_limits(double max_force_n, double max_torque_nm) noexcept {
  device_force_n_ = std::isfinite(max_force_n) ? std::max(0.0, max_force_n) : 0;
  device_torque_nm_ = std::isfinite(max_torque_nm) ? std::max(0.0, max_torque_nm) : 0;
}

void ForceSafety::clear_fault() noexcept {
  faulted_ = false;
  restart();
}

void ForceSafety::restart() noexcept {
  gain_ = 0;
  passivity_.restart();
}

// What the hand did since the last tick, under the force that was sent then.
void ForceSafety::follow(const SafetyInput& input) noexcept {
  if (known_place_ && !input.reconnected) {
    const Vec3 way = input.tip - tip_;
    if (input.dt_s > 0) velocity_ = way / input.dt_s;
    passivity_.observe(sent_, way, rotation_between(orientation_, input.orientation), input.stored_j,
                       input.dt_s);
  } else {
    velocity_.setZero();
  }
  known_place_ = input.engaged;
  tip_ = input.tip;
  orientation_ = input.orientation;
}

void ForceSafety::fade_to(const SafetyInput& input, std::uint32_t& state) noexcept {
  if (input.reconnected) gain_ = 0;
  const bool fresh = input.engaged && input.pose_age_s <= limits_.stale_s;
  gain_ = fade(gain_, fresh, limits_, input.dt_s);
  // a tick that came late must not stretch the decay
  const double spent = (input.pose_age_s - limits_.stale_s) / limits_.decay_s;
  if (!fresh) gain_ = input.engaged ? std::clamp(1 - spent, 0.0, gain_) : 0;
  if (!fresh) state |= msg::FORCE_STALE;
  if (fresh && gain_ < 1) state |= msg::FORCE_RAMP;
}

Wrench ForceSafety::filter(const SafetyInput& input, std::uint32_t& state) noexcept {
  Wrench wrench = input.model;
  if (gain_ < 1) {
    wrench.force *= gain_;
    wrench.torque *= gain_;
  }
  const Vec3 damping = passivity_.damping(velocity_, input.dt_s);
  if (!damping.isZero(0) && gain_ > 0) {
    wrench.force += gain_ * damping;
    state |= msg::FORCE_PASSIVITY;
  }
  const double max_force_n =
      device_force_n_ > 0 ? std::min(device_force_n_, limits_.max_force_n) : limits_.max_force_n;
  const double max_torque_nm =
      device_torque_nm_ > 0 ? std::min(device_torque_nm_, limits_.max_torque_nm) : limits_.max_torque_nm;
  if (clamp_wrench(wrench, max_force_n, max_torque_nm)) state |= msg::FORCE_CLAMPED;
  if (slew_wrench(wrench, sent_, limits_, input.dt_s)) state |= msg::FORCE_SLEW;
  // the decay binds what leaves, the slew limit included
  if (state & msg::FORCE_STALE) clamp_wrench(wrench, gain_ * max_force_n, gain_ * max_torque_nm);
  return wrench;
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
  if (input.paused) {
    restart();
    out.state |= msg::FORCE_PAUSED;
  }
  if (!faulted_ && !input.paused) out.wrench = filter(input, out.state);
  if (!is_finite(out.wrench)) faulted_ = true;
  if (faulted_) {
    restart();
    out = {Wrench{}, out.state | msg::FORCE_FAULT};
  }
  sent_ = out.wrench;
  return out;
}

}  // namespace omentum::haptic
