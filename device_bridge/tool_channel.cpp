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

ToolChannel::ToolChannel(std::unique_ptr<Device> device, runtime::FaultList& faults)
    : device_(std::move(device)),
      info_(checked(device_->info())),
      faults_(faults),
      bad_force_("tool " + std::to_string(info_.tool) +
                 ": a force that is not finite arrived and was ignored"),
      foreign_answer_("tool " + std::to_string(info_.tool) +
                      ": an answer to another device's pose arrived and was ignored"),
      bad_measurement_("tool " + std::to_string(info_.tool) +
                       ": the device measured a pose that is not finite"),
      old_measurement_("tool " + std::to_string(info_.tool) +
                       ": the device's newest measurement is not of this moment"),
      hold_(info_.max_force_n, info_.max_torque_nm),
      guard_(info_.max_force_n, info_.max_torque_nm, info_.actuated_axes) {
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
  const Wrench held = hold_.at(now_ns);
  const Exerted newest{guard_.limit(held, now_ns), hold_.answer_seq()};
  device_->command(newest.wrench);

  // what moved the hand to where it is measured now
  const Exerted moving = device_->simulates() ? newest : exerted_;
  exerted_ = newest;
  pose_.answer_seq = moving.answer_seq;
  const Vec3 before = from_message(pose_.position);
  const double opened_before = pose_.grip;
  const bool moved_from_there = pose_.valid;
  const Measurement measured = device_->measure(now_ns);
  fill(measured, now_ns);
  guard_.follow(measured, pose_.valid, device_->simulates());
  if (moved_from_there && pose_.valid) {
    energy_j_ += moving.wrench.force.dot(from_message(pose_.position) - before) +
                 moving.wrench.grip_torque * (pose_.grip - opened_before);
    most_energy_j_ = std::max(most_energy_j_, energy_j_);
  }
  gate_.sent(pose_.seq, pose_.stamp_ns);
  return pose_;
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
  const std::string* fault = m.valid ? objection(m, now_ns) : nullptr;
  if (fault) faults_.raise(*fault);
  ++pose_.seq;
  pose_.valid = m.valid && !fault;
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
