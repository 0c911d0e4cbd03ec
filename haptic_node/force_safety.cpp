#include "haptic_node/force_safety.h"

#include "haptic_node/tool_kinematics.h"
#include "transport/messages.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

// Poses that a device may be late by before it counts as silent.
constexpr double kStaleIntervals = 2.5;
// A force written now acts until the answer to the next pose but one: one interval until that pose, one more
// until the device turns to its answer.
constexpr double kHorizonIntervals = 2;
// What the noise of a tracker seems to give at most, W: stiffness times its variance times the rate, 20 um of
// noise against 1 kN/m at 1 kHz.
constexpr double kTrackerNoise_w = 0.4e-3;

bool shorten(Vec3& v, double limit) {
  const double length = v.norm();
  if (length <= limit) return false;
  v *= limit / length;
  return true;
}

bool shorten(double& x, double limit) {
  const double before = x;
  x = std::clamp(x, -limit, limit);
  return x != before;
}

template <class T>
bool approach(T& target, const T& from, double limit) {
  T change = target - from;
  if (!shorten(change, limit)) return false;
  target = from + change;
  return true;
}

bool is_in_air(const SafetyInput& input) {
  return input.model.force.isZero(0) && input.model.torque.isZero(0);
}

}  // namespace

bool clamp_wrench(Wrench& wrench, double max_force_n, double max_torque_nm) noexcept {
  const bool force = shorten(wrench.force, max_force_n), torque = shorten(wrench.torque, max_torque_nm),
             grip = shorten(wrench.grip_torque, max_torque_nm);
  return force || torque || grip;
}

bool slew_wrench(Wrench& wrench, const Wrench& before, const ForceLimits& limits, double dt_s) noexcept {
  const double step_n = limits.max_slew_n_s * dt_s,
               step_nm = step_n * limits.max_torque_nm / limits.max_force_n;
  const bool force = approach(wrench.force, before.force, step_n);
  const bool torque = approach(wrench.torque, before.torque, step_nm);
  const bool grip = approach(wrench.grip_torque, before.grip_torque, step_nm);
  return force || torque || grip;
}

double fade(double gain, bool fresh, const ForceLimits& limits, double dt_s) noexcept {
  return fresh ? std::min(1.0, gain + dt_s / limits.ramp_s) : std::max(0.0, gain - dt_s / limits.decay_s);
}

double stale_after(double pose_interval_s, const ForceLimits& limits) noexcept {
  const double longest_s = std::max(limits.stale_s, kLongestStale_s);
  return std::clamp(kStaleIntervals * pose_interval_s, limits.stale_s, longest_s);
}

void ForceSafety::set_device(const DeviceLimits& device) noexcept {
  device_ = device;
  acting_.set_limits(max_force_n(), max_torque_nm());
}

void ForceSafety::clear_fault() noexcept {
  faulted_ = false;
  restart();
}

// How long the hand goes on unseen after a pose.
double ForceSafety::interval_s(const SafetyInput& input) const noexcept {
  return input.pose_interval_s > 0 ? input.pose_interval_s : std::max(way_s_, limits_.period_s);
}

// What the hand did since the last tick, under the forces that may have acted.
void ForceSafety::follow(const SafetyInput& input) noexcept {
  acting_.age(input.dt_s);
  if (input.written) acting_.tell(passed_, told_valid_s_, input.dt_s);
  told_valid_s_ = stale_after(input.pose_interval_s, limits_);
  const bool same_hand = known_place_ && !input.reconnected;
  if (same_hand && input.way_s > 0) {
    const Vec3 way = input.tip - tip_, turn = rotation_between(orientation_, input.orientation);
    const double opened_rad = input.grip - grip_;
    const ActingForce::Work given = acting_.work(way, turn, input.way_s, opened_rad);
    charge({given.soon_j - reckoned_.soon_j, given.late_j - reckoned_.late_j}, input);
    reckoned_ = {};
    way_s_ = input.way_s;
    motion_.follow(way, turn, way_s_, opened_rad);
  } else {
    reckon(input);
  }
  if (!same_hand) {
    // where it was meanwhile nobody knows: what was charged stays
    reckoned_ = {};
    motion_ = {};
  }
  known_place_ = input.engaged;
  tip_ = input.tip;
  orientation_ = input.orientation;
  grip_ = input.grip;
}

// While nothing is heard the hand may go on as it did. The next pose puts it right.
void ForceSafety::reckon(const SafetyInput& input) noexcept {
  const ActingForce::Work ahead = acting_.work(motion_.velocity * input.dt_s, motion_.turn_rate * input.dt_s,
                                               input.dt_s, motion_.grip_rate * input.dt_s);
  const ActingForce::Work given{std::max(0.0, ahead.soon_j), std::max(0.0, ahead.late_j)};
  reckoned_.soon_j += given.soon_j;
  reckoned_.late_j += given.late_j;
  charge(given, input);
}

void ForceSafety::charge(const ActingForce::Work& given, const SafetyInput& input) noexcept {
  // a pose's noise is in the answer to it and in the way that begins with it: work that no hand received
  const double noise_j = std::clamp(soon_.given_j() - late_.given_j(), 0.0, kTrackerNoise_w * input.dt_s);
  soon_.observe(given.soon_j - noise_j, input.stored_j, input.dt_s);
  late_.observe(given.late_j, input.stored_j, input.dt_s);
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
}

// Both parts share one slew. The damper has it first: the tank does not cover what it does.
Wrench ForceSafety::filter(const SafetyInput& input, std::uint32_t& state) noexcept {
  const Vec3 damper = wanted_damper(input);
  const double taken_s = std::min((damper - damping_).norm() / limits_.max_slew_n_s, slew_s(input));
  Wrench wrench{gain_ * input.model.force, gain_ * input.model.torque, gain_ * input.model.grip_torque};
  limit(input, slew_s(input) - taken_s, wrench, state);
  const Vec3 slewed = wrench.force;
  // the decay binds what leaves, the slew limit included
  if (state & (msg::FORCE_STALE | msg::FORCE_PAUSED))
    clamp_wrench(wrench, gain_ * max_force_n(), gain_ * max_torque_nm());
  // last of all: what falls by this falls at once
  ahead_j_ = node::work_ahead_j(wrench.force, wrench.torque, motion_, kHorizonIntervals * interval_s(input),
                                wrench.grip_torque);
  share_ = tank().share(ahead_j_);
  if (share_ < 1) state |= msg::FORCE_PASSIVITY;
  wrench.force *= share_;
  wrench.torque *= share_;
  wrench.grip_torque *= share_;
  const double fallen = slewed.isZero(0) ? 1 : wrench.force.norm() / slewed.norm();
  damp(input, damper, {fallen, (slewed - model_.force).norm()}, wrench, state);
  return wrench;
}

void ForceSafety::limit(const SafetyInput& input, double slew_s, Wrench& wrench,
                        std::uint32_t& state) const noexcept {
  drop_unactuated(wrench, device_.actuated_axes, input.orientation);
  if (clamp_wrench(wrench, max_force_n(), max_torque_nm())) state |= msg::FORCE_CLAMPED;
  // a stall is no reason to step: it counts for one period
  if (slew_wrench(wrench, model_, limits_, slew_s)) state |= msg::FORCE_SLEW;
}

// A debt is taken out of the hand's own motion where there is tissue; in the air nothing may be felt.
Vec3 ForceSafety::wanted_damper(const SafetyInput& input) const noexcept {
  Wrench damper{is_in_air(input) ? Vec3::Zero() : Vec3(gain_ * tank().damping(motion_, interval_s(input))),
                Vec3::Zero()};
  drop_unactuated(damper, device_.actuated_axes, input.orientation);
  approach(damper.force, damping_, limits_.max_slew_n_s * slew_s(input));
  return damper.force;
}

// With m and d, what left in the last tick, and the model's part fallen to s (m + change), m + d falls to its
// share s as well, and from there on the sum makes one step of the slew limit at most.
void ForceSafety::damp(const SafetyInput& input, const Vec3& damper, const Fall& fall, Wrench& wrench,
                       std::uint32_t& state) noexcept {
  const double step_n = limits_.max_slew_n_s * slew_s(input);
  const bool nothing_left = wrench.force.isZero(0) && (is_in_air(input) || gain_ <= 0);
  const Vec3 from = fall.share * damping_;
  damping_ = nothing_left ? Vec3::Zero() : damper;
  if (!nothing_left) approach(damping_, from, std::max(0.0, step_n - fall.share * fall.change_n));
  if (!damping_.isZero(0)) state |= msg::FORCE_PASSIVITY;
  const bool decays = state & (msg::FORCE_STALE | msg::FORCE_PAUSED);
  const double sum_n = (wrench.force + damping_).norm(), most_n = (decays ? gain_ : 1) * max_force_n();
  const double kept = sum_n > most_n ? most_n / sum_n : 1;
  damping_ *= kept;
  wrench.force *= kept;
  model_ = wrench;
  wrench.force += damping_;
}

void ForceSafety::let_go() noexcept {
  restart();
  model_ = {};
  damping_.setZero();
}

SafeForce ForceSafety::pass(const SafetyInput& input) noexcept {
  SafeForce out;
  const bool in_place = input.tip.allFinite() && input.orientation.coeffs().allFinite() &&
                        std::isfinite(input.grip) && std::isfinite(input.dt_s) && input.dt_s >= 0 &&
                        std::isfinite(input.pose_age_s);
  if (!in_place || !is_finite(input.model) || !std::isfinite(input.stored_j)) faulted_ = true;
  if (in_place) {
    follow(input);
    fade_to(input, out.state);
  }
  if (!faulted_) out.wrench = filter(input, out.state);
  if (!is_finite(out.wrench)) faulted_ = true;
  if (faulted_) {
    let_go();
    out = {Wrench{}, out.state | msg::FORCE_FAULT};
  }
  passed_ = out.wrench;
  return out;
}

}  // namespace omentum::haptic
