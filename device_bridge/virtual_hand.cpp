#include "device_bridge/virtual_hand.h"

#include "geometry/trocar.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace omentum::device {
namespace {

// A person's hand moves continuously: steps much finer than any device rate make it feel the same at every
// rate.
constexpr double kLongestSubstep_s = 0.25e-3;
constexpr double kPaceChange_s =
    0.1;                           // to stop or to go on: no jerk in the hand, and soon enough for a person
constexpr double kReturn_s = 1.0;  // to glide back to the start: below 0.1 m/s for a path of 5 cm

// Limits of a common table-top device; the stiffness is what such devices render at 1 kHz.
constexpr double kMaxHandForce_n = 20;
constexpr double kMaxHandTorque_nm = 1;
constexpr double kMaxHandStiffness_n_m = 3000;
constexpr double kReach_m = 0.5;

}  // namespace

VirtualHand::VirtualHand(const scene::HandSpec& hand, const scene::ToolSpec& tool, double rate_hz,
                         const std::optional<MappingSpec>& mapping)
    : hand_(hand),
      tool_(tool),
      period_s_(1 / rate_hz),
      substeps_(static_cast<int>(std::ceil(period_s_ / kLongestSubstep_s - 1e-9))),
      mapping_(mapping),
      script_(script_at(hand, 0)),
      target_(target_of(hand, script_)),
      tip_(target_),
      held_(hand_at(tip_)),
      orientation_(orientation()),
      return_s_(kReturn_s) {}

msg::DeviceInfo VirtualHand::info() const {
  const Vec3 middle(hand_.press_point.data());
  msg::DeviceInfo info;
  info.tool = hand_.tool;
  info.name = "virtual hand";
  info.max_force_n = kMaxHandForce_n;
  info.max_torque_nm = kMaxHandTorque_nm;
  info.max_stiffness_n_m = kMaxHandStiffness_n_m;
  info.damping_n_s_m = hand_.damping_n_s_m;
  info.workspace_min = to_message(middle - Vec3::Constant(kReach_m));
  info.workspace_max = to_message(middle + Vec3::Constant(kReach_m));
  constexpr std::uint32_t kPlace = msg::AXIS_X | msg::AXIS_Y | msg::AXIS_Z;
  info.actuated_axes = kPlace | (tool_.shape == "grasper" ? msg::AXIS_GRIP : 0);
  info.sensed_axes = kPlace | msg::AXIS_PITCH | msg::AXIS_YAW | msg::AXIS_ROLL | msg::AXIS_GRIP;
  return info;
}

Measurement VirtualHand::measure(std::int64_t now_ns) noexcept {
  const double dt_s = period_s_ / substeps_;
  for (int i = 0; i < substeps_; ++i) {
    target_ = advance_target(dt_s);
    held_ = step_hand(hand_, held_, hand_at(target_), wrench_.force, dt_s);
  }
  tip_ = tip_at(held_);
  const Quat before = orientation_;
  orientation_ = orientation();
  record();
  const Measurement tool{.valid = true,
                         .measured_ns = now_ns,
                         .position = tip_.position,
                         .orientation = orientation_,
                         .linear_velocity = tip_.velocity,
                         .angular_velocity = angular_velocity(before, orientation_, period_s_),
                         .grip = script_.grip_rad,
                         .buttons = hand_.cut && script_.phase == Phase::kSlide ? msg::BUTTON_CUT : 0};
  return mapping_ ? hand_of(*mapping_, tool) : tool;
}

Motion VirtualHand::hand_at(const Motion& tip) const noexcept {
  if (!mapping_) return tip;
  const Measurement hand = hand_of(*mapping_, {.position = tip.position, .linear_velocity = tip.velocity});
  return {hand.position, hand.linear_velocity};
}

Motion VirtualHand::tip_at(const Motion& hand) const noexcept {
  if (!mapping_) return hand;
  const Measurement tip = tool_of(*mapping_, {.position = hand.position, .linear_velocity = hand.velocity});
  return {tip.position, tip.linear_velocity};
}

Motion VirtualHand::advance_target(double dt_s) noexcept {
  pace_ = std::clamp(pace_ + (paused_ ? -dt_s : dt_s) / kPaceChange_s, 0.0, 1.0);
  // the way back to the start comes first, then the script
  return_s_ += dt_s * pace_;
  if (return_s_ > kReturn_s) script_s_ += dt_s * pace_;
  script_ = script_at(hand_, script_s_);
  Motion target = target_of(hand_, script_);
  const double share = return_s_ / kReturn_s;
  target.position += return_from_ * (1 - minimum_jerk(share));
  target.velocity -= return_from_ * minimum_jerk_rate(share) / kReturn_s;
  target.velocity *= pace_;
  return target;
}

void VirtualHand::restart() noexcept {
  return_from_ = target_.position - target_of(hand_, script_at(hand_, 0)).position;
  return_s_ = 0;
  script_s_ = 0;
}

Quat VirtualHand::orientation() const noexcept {
  const Vec3 normal(hand_.press_normal.data());
  const Vec3 to_pivot = tool_.trocar ? Vec3(*tool_.trocar - tip_.position) : Vec3::Zero();
  const Vec3 shaft = to_pivot.squaredNorm() > 0 ? to_pivot : normal;
  // who holds a scope holds it level, whoever holds another tool does not care
  const Quat held = tool_.scope ? geometry::level_orientation(shaft) : shaft_orientation(shaft);
  return script_.roll_rad == 0 ? held : Quat(held * Eigen::AngleAxisd(script_.roll_rad, Vec3::UnitZ()));
}

void VirtualHand::record() noexcept {
  const Vec3 press_point(hand_.press_point.data()), normal(hand_.press_normal.data());
  const double force_n = wrench_.force.norm();
  peak_force_n_ = std::max(peak_force_n_, force_n);
  peak_grip_torque_nm_ = std::max(peak_grip_torque_nm_, std::abs(wrench_.grip_torque));
  deepest_target_m_ = std::max(deepest_target_m_, (press_point - target_.position).dot(normal));
  deepest_tip_m_ = std::max(deepest_tip_m_, (press_point - tip_.position).dot(normal));
  if (script_.height_m < 0) press_force_n_.add(force_n);
  if (script_.phase == Phase::kHold && script_.phase_share >= 0.5) hold_force_n_.add(force_n);
}

nlohmann::json VirtualHand::report() const {
  return {{"tool", hand_.tool},
          {"peak_force_n", peak_force_n_},
          {"peak_grip_torque_nm", peak_grip_torque_nm_},
          {"mean_force_n", press_force_n_.value()},
          {"hold_force_n", hold_force_n_.value()},
          {"deepest_target_m", deepest_target_m_},
          {"deepest_tip_m", deepest_tip_m_}};
}

}  // namespace omentum::device
