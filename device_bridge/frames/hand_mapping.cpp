#include "device_bridge/frames/hand_mapping.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace omentum::device {
namespace {

// What haptic_node believes of a device (docs/topics.md, "For a device"): of a hand that moves a tool by
// micrometres the same would be more.
constexpr double kMostForce_n = 1000, kMostTorque_nm = 100, kMostStiffness_n_m = 1e6, kLeastStiffness_n_m = 1;

// The mapping raises no limit above this bound; one that the device itself put there stays there, and is
// told.
double believable(double told, double ratio, double most) {
  return std::min(told / ratio, std::max(told, most));
}

// What would be less is not raised either: the hand would feel `ratio` times it, which its device cannot
// hold.
double stiffness_left(const msg::DeviceInfo& info, double ratio) {
  const double left = believable(info.max_stiffness_n_m, ratio, kMostStiffness_n_m);
  if (info.max_stiffness_n_m < kLeastStiffness_n_m || left >= kLeastStiffness_n_m) return left;
  std::ostringstream words;
  words << "tool " << info.tool << ": of the device's max_stiffness_n_m, " << info.max_stiffness_n_m << ", "
        << left << " N/m is left at the tool, expected at least " << kLeastStiffness_n_m
        << ": a larger least_outside_m, or a smaller scale or force_scale";
  throw std::runtime_error(words.str());
}

bool is_pressed(const std::optional<std::uint32_t>& button, std::uint32_t buttons) {
  return button && (buttons >> *button & 1U) != 0;
}

Wrench times(const Wrench& wrench, double factor) {
  return {factor * wrench.force, factor * wrench.torque, factor * wrench.grip_torque};
}

// The box around a box of the device's, in W.
void enclose(const BaseFrame& base, msg::DeviceInfo& info) {
  const Vec3 low = from_message(info.workspace_min), high = from_message(info.workspace_max);
  const Vec3 middle = base.p_WB + base.scale * (base.q_WB * Vec3((low + high) / 2));
  const Vec3 half = base.scale * (base.q_WB.toRotationMatrix().cwiseAbs() * Vec3((high - low) / 2));
  info.workspace_min = to_message(middle - half);
  info.workspace_max = to_message(middle + half);
}

}  // namespace

Measurement tool_of(const MappingSpec& spec, const Measurement& hand) noexcept {
  const Measurement held = to_scene(spec.base, hand);
  return spec.lever ? at_tip(*spec.lever, held) : held;
}

Measurement hand_of(const MappingSpec& spec, const Measurement& tool) noexcept {
  return to_base(spec.base, spec.lever ? at_handle(*spec.lever, tool) : tool);
}

Measurement HandMapping::to_tool(const Measurement& hand) noexcept {
  const bool enabled = !spec_.enable_button || is_pressed(spec_.enable_button, hand.buttons);
  const Measurement held =
      clutch_.follow(to_scene(spec_.base, hand), is_pressed(spec_.clutch_button, hand.buttons));
  off_trocar_ = spec_.lever && !goes_through(*spec_.lever, held);
  holds_ = enabled && !off_trocar_ && !clutch_.held();
  if (!off_trocar_) held_ = held;
  known_ = known_ || !off_trocar_;
  Measurement tool = spec_.lever && !off_trocar_ ? at_tip(*spec_.lever, held) : held;
  tool.valid = hand.valid && enabled && !off_trocar_;
  return tool;
}

Wrench HandMapping::to_hand(const Wrench& at_tool, double dt_s) noexcept {
  if (fades()) engagement_.pass(holds_, dt_s);
  if (spec_.lever && !known_) return {};
  const Wrench held = spec_.lever ? at_handle(*spec_.lever, held_, at_tool) : at_tool;
  return times(to_base(spec_.base, held), share() * spec_.force_scale);
}

msg::DeviceInfo HandMapping::describe(msg::DeviceInfo info) const {
  const double ratio = spec_.lever ? largest_ratio(*spec_.lever) : 1;
  // one newton at the tool is so many in the hand, and a metre of it 1 / s of the hand's
  const double force_ratio = spec_.force_scale * spec_.base.scale;
  const double stiffness_ratio = force_ratio * spec_.base.scale * ratio * ratio;
  info.max_force_n = believable(info.max_force_n, force_ratio * ratio, kMostForce_n);
  info.max_torque_nm = believable(info.max_torque_nm, spec_.force_scale, kMostTorque_nm);
  info.max_stiffness_n_m = stiffness_left(info, stiffness_ratio);
  info.damping_n_s_m /= stiffness_ratio;
  if (spec_.lever) {
    const Vec3 reach = Vec3::Constant(spec_.lever->length_m - spec_.lever->least_outside_m);
    info.workspace_min = to_message(spec_.lever->pivot - reach);
    info.workspace_max = to_message(spec_.lever->pivot + reach);
  } else {
    enclose(spec_.base, info);
  }
  return info;
}

}  // namespace omentum::device
