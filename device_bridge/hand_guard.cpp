#include "device_bridge/hand_guard.h"

#include "device_bridge/hand_model.h"

#include <algorithm>
#include <cmath>

namespace omentum::device {
namespace {

// Less than this is no contact, N and N m.
constexpr double kFree_n = 0.05, kFree_nm = 1e-3;

double risen(double from, double target, double step) {
  const double fallen = from > 0 ? std::clamp(target, 0.0, from) : std::clamp(target, from, 0.0);
  return fallen + std::clamp(target - fallen, -step, step);
}

// The change that a vector may make: it falls as it likes, from there on `step` towards the target.
Vec3 risen(const Vec3& from, const Vec3& target, double step) {
  const double squared = from.squaredNorm();
  const double kept = squared > 0 ? std::clamp(target.dot(from) / squared, 0.0, 1.0) : 0;
  const Vec3 fallen = kept * from, change = target - fallen;
  const double length = change.norm();
  return length > step ? Vec3(fallen + change * (step / length)) : target;
}

void scale(Wrench& wrench, double share) {
  wrench.force *= share;
  wrench.torque *= share;
  wrench.grip_torque *= share;
}

Vec3 turn_between(const Quat& from, const Quat& to) {
  return angular_velocity(from, to, 1);
}

}  // namespace

void HandGuard::only_actuated(Vec3& force) const noexcept {
  if (axes_ == 0) return;
  for (int i = 0; i < 3; ++i) {
    if (!(axes_ & msg::AXIS_X << i)) force[i] = 0;
  }
}

void HandGuard::rise_to(Wrench& wrench, double rise_s) const noexcept {
  wrench.force = risen(exerted_.force, wrench.force, kFastest_n_s * rise_s);
  wrench.torque = risen(exerted_.torque, wrench.torque, kFastest_nm_s * rise_s);
  wrench.grip_torque = risen(exerted_.grip_torque, wrench.grip_torque, kFastest_nm_s * rise_s);
}

Wrench HandGuard::limit(const Wrench& asked, std::int64_t now_ns) noexcept {
  period_before_s_ = period_s_;
  period_s_ = limited_ ? 1e-9 * static_cast<double>(now_ns - limited_ns_) : 0;
  limited_ns_ = now_ns;
  limited_ = true;

  asked_ = asked;
  Wrench wrench = asked;
  only_actuated(wrench.force);
  if (!drives_grip()) wrench.grip_torque = 0;
  const double rise_s = std::min(period_s_, period_before_s_);
  rise_to(wrench, rise_s);
  // the hand is seen again in the next period, and the one before is not seen yet
  const double unseen_s = std::max({period_s_, period_before_s_, way_s_});
  const double share =
      tank_.share(node::work_ahead_j(wrench.force, wrench.torque, motion_, 2 * unseen_s, wrench.grip_torque));
  if (share < 1) ++held_back_;
  scale(wrench, share);
  if (!(asked.force.isZero(0) && asked.torque.isZero(0))) {  // in the air nothing may be felt
    Vec3 damping = tank_.damping(motion_, unseen_s);
    only_actuated(damping);
    wrench.force += damping;
    rise_to(wrench, rise_s);
  }
  const double norm = wrench.force.norm();
  if (norm > max_force_n_) wrench.force *= max_force_n_ / norm;
  const double torque_norm = wrench.torque.norm();  // a lever makes other ones of it than were answered
  if (torque_norm > max_torque_nm_) wrench.torque *= max_torque_nm_ / torque_norm;
  exerted_before_ = exerted_;
  return exerted_ = wrench;
}

// No elastic tissue holds more than the force that it gives now along the way from where the hand was free.
double HandGuard::stored_j() noexcept {
  const double grip_torque_nm = drives_grip() ? std::abs(asked_.grip_torque) : 0;
  if (asked_.force.norm() < kFree_n && asked_.torque.norm() < kFree_nm && grip_torque_nm < kFree_nm) {
    free_tip_ = tip_;
    free_orientation_ = orientation_;
    free_grip_ = grip_;
  }
  return asked_.force.norm() * (tip_ - free_tip_).norm() +
         asked_.torque.norm() * turn_between(free_orientation_, orientation_).norm() +
         grip_torque_nm * std::abs(grip_ - free_grip_);
}

void HandGuard::arrive(const Measurement& measured) noexcept {
  tip_ = measured.position;
  orientation_ = measured.orientation.normalized();
  grip_ = measured.grip;
  measured_ns_ = measured.measured_ns;
  impulse_.setZero();
  angular_impulse_.setZero();
  grip_impulse_ = 0;
  acted_s_ = 0;
  reckoned_j_ = 0;
  known_place_ = true;
}

// What moved the hand in this period: a simulated one the newest command, hardware the one before.
void HandGuard::act(bool simulated) noexcept {
  const Wrench& acting = simulated ? exerted_ : exerted_before_;
  impulse_ += period_s_ * acting.force;
  angular_impulse_ += period_s_ * acting.torque;
  grip_impulse_ += period_s_ * acting.grip_torque;
  acted_s_ += period_s_;
}

// Unseen the hand may go on as it did. The next measurement puts it right.
void HandGuard::reckon() noexcept {
  const double power_w = exerted_.force.dot(motion_.velocity) + exerted_.torque.dot(motion_.turn_rate) +
                         exerted_.grip_torque * motion_.grip_rate;
  const double charged_j = std::max(0.0, power_w * period_s_);
  reckoned_j_ += charged_j;
  tank_.observe(charged_j, stored_j(), period_s_);
}

void HandGuard::follow(const Measurement& measured, bool usable, bool simulated) noexcept {
  act(simulated);
  if (!usable || (known_place_ && measured.measured_ns <= measured_ns_)) {
    reckon();
    known_place_ = known_place_ && usable;
    return;
  }
  if (!known_place_) {
    // where it was meanwhile nobody knows: what was charged stays
    motion_ = {};
    way_s_ = 0;
    arrive(measured);
    return;
  }
  const Vec3 way = measured.position - tip_;
  const Vec3 turn = turn_between(orientation_, measured.orientation.normalized());
  const double opened_rad = measured.grip - grip_;
  way_s_ = 1e-9 * static_cast<double>(measured.measured_ns - measured_ns_);
  motion_.follow(way, turn, way_s_, opened_rad);
  const double worked = impulse_.dot(way) + angular_impulse_.dot(turn) + grip_impulse_ * opened_rad;
  const double work_j = acted_s_ > 0 ? worked / acted_s_ : 0;
  const double given_j = work_j - reckoned_j_;
  arrive(measured);
  tank_.observe(given_j, stored_j(), period_s_);
}

}  // namespace omentum::device
