#include "device_bridge/tool_channel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace omentum::device {
namespace {

constexpr auto kOldestMeasurement_ns = static_cast<std::int64_t>(1e9 * kOldestMeasurement_s);

bool finite(const Measurement& m) {
  return m.position.allFinite() && m.orientation.coeffs().allFinite() && m.linear_velocity.allFinite() &&
         m.angular_velocity.allFinite() && std::isfinite(m.grip);
}

void require_limit(const char* name, double limit, std::uint32_t tool) {
  if (std::isfinite(limit) && limit >= 0) return;
  throw std::runtime_error("tool " + std::to_string(tool) + ": DeviceInfo." + name + ": found " +
                           std::to_string(limit) + ", expected a finite number, not negative");
}

// a limit that is no number would clamp nothing
msg::DeviceInfo checked(const msg::DeviceInfo& info) {
  if (info.tool >= msg::MAX_TOOLS) {
    throw std::runtime_error("DeviceInfo.tool: found " + std::to_string(info.tool) + ", expected at most " +
                             std::to_string(msg::MAX_TOOLS - 1));
  }
  require_limit("max_force_n", info.max_force_n, info.tool);
  require_limit("max_torque_nm", info.max_torque_nm, info.tool);
  return info;
}

}  // namespace

ToolChannel::ToolChannel(std::unique_ptr<Device> device, runtime::FaultList& faults,
                         const MappingSpec& mapping)
    : device_(std::move(device)),
      mapping_(mapping),
      info_(mapping_.describe(checked(device_->info()))),
      faults_(faults),
      bad_force_("tool " + std::to_string(info_.tool) +
                 ": a force that is not finite arrived and was ignored"),
      foreign_answer_("tool " + std::to_string(info_.tool) +
                      ": an answer to another device's pose arrived and was ignored"),
      bad_measurement_("tool " + std::to_string(info_.tool) +
                       ": the device measured a pose that is not finite"),
      old_measurement_("tool " + std::to_string(info_.tool) +
                       ": the device's newest measurement is not of this moment"),
      off_trocar_("tool " + std::to_string(info_.tool) +
                  ": the device's handle does not go through the trocar"),
      hold_(info_.max_force_n, info_.max_torque_nm),
      guard_(device_->info().max_force_n, device_->info().max_torque_nm, info_.actuated_axes) {
  pose_.tool = info_.tool;
  pose_.orientation.w = 1;
}

AnswerVerdict ToolChannel::receive(const msg::ToolForce& answer, std::int64_t now_ns) noexcept {
  const AnswerVerdict verdict = gate_.judge(answer, now_ns);
  if (verdict == AnswerVerdict::kForeign) faults_.raise(foreign_answer_);
  if (verdict != AnswerVerdict::kAccepted) return verdict;
  received_.draft() = {answer, now_ns};
  received_.post();
  return verdict;
}

const msg::ToolPose& ToolChannel::tick(std::int64_t now_ns) noexcept {
  if (received_.fetch() && !hold_.take(received_.value().answer, received_.value().at_ns)) {
    faults_.raise(bad_force_);
  }
  const double dt_s = ticked_ns_ == 0 ? 0 : 1e-9 * static_cast<double>(now_ns - ticked_ns_);
  ticked_ns_ = now_ns;
  const Wrench asked = mapping_.to_hand(hold_.at(now_ns), dt_s);
  const Exerted newest{guard_.limit(asked, now_ns), mapping_.share() > 0 ? hold_.answer_seq() : 0};
  device_->command(newest.wrench);

  // what moved the hand to where it is measured now
  const Exerted moving = device_->simulates() ? newest : exerted_;
  exerted_ = newest;
  pose_.answer_seq = moving.answer_seq;
  Measurement hand = device_->measure(now_ns);
  hand.valid = usable(hand, now_ns);
  guard_.follow(hand, hand.valid, device_->simulates());
  account(hand, moving.wrench);
  Measurement tool = hand;
  if (hand.valid) {
    tool = mapping_.to_tool(hand);
    if (mapping_.off_trocar()) faults_.raise(off_trocar_);
  } else {
    mapping_.lose();
  }
  fill(tool, now_ns);
  gate_.sent(pose_.seq, pose_.stamp_ns);
  return pose_;
}

void ToolChannel::account(const Measurement& hand, const Wrench& moving) noexcept {
  if (hand_.valid && hand.valid) {
    energy_j_ +=
        moving.force.dot(hand.position - hand_.position) + moving.grip_torque * (hand.grip - hand_.grip);
    most_energy_j_ = std::max(most_energy_j_, energy_j_);
  }
  if (hand.valid) hand_ = hand;  // of one that cannot be used nothing is kept
  hand_.valid = hand.valid;
}

bool ToolChannel::usable(const Measurement& hand, std::int64_t now_ns) noexcept {
  const std::string* fault = hand.valid ? objection(hand, now_ns) : nullptr;
  if (fault) faults_.raise(*fault);
  return hand.valid && !fault;
}

// The fault of a measurement that must not be used; null when it may be. One from the future is of another
// clock.
const std::string* ToolChannel::objection(const Measurement& m, std::int64_t now_ns) const noexcept {
  if (!finite(m)) return &bad_measurement_;
  const bool of_now =
      m.measured_ns >= now_ns - kOldestMeasurement_ns && m.measured_ns <= now_ns + kOldestMeasurement_ns;
  return of_now ? nullptr : &old_measurement_;
}

void ToolChannel::fill(const Measurement& m, std::int64_t now_ns) noexcept {
  ++pose_.seq;
  pose_.valid = m.valid;
  pose_.stamp_ns = pose_.valid ? m.measured_ns : now_ns;
  if (!pose_.valid) return;
  const Quat q = m.orientation.normalized();
  pose_.buttons = m.buttons;
  pose_.position = to_message(m.position);
  pose_.orientation = {q.w(), q.x(), q.y(), q.z()};
  pose_.linear_velocity = to_message(m.linear_velocity);
  pose_.angular_velocity = to_message(m.angular_velocity);
  pose_.grip = m.grip;
}

}  // namespace omentum::device
