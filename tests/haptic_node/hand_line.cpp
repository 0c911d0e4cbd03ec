#include "hand_line.h"

#include "haptic_node/tool_kinematics.h"
#include "node_common/vectors.h"

#include <algorithm>

namespace omentum::haptic_test {
namespace {

// Of a common table-top device, N and N m: the simulated hand's.
constexpr double kMaxForce_n = 20, kMaxTorque_nm = 1;

haptic::ForceLimits limits_at(double rate_hz) {
  haptic::ForceLimits limits;
  limits.period_s = 1 / rate_hz;
  return limits;
}

}  // namespace

HandLine::HandLine(std::uint32_t tool, double rate_hz)
    : line_(tool, limits_at(rate_hz), faults_), hold_(kMaxForce_n, kMaxTorque_nm), period_s_(1 / rate_hz) {
  pose_.tool = tool;
  pose_.valid = true;
}

const device::Wrench& HandLine::exert(std::int64_t now_ns) {
  exerted_ = hold_.at(now_ns);
  return exerted_;
}

haptic::ToolInput HandLine::hear(const haptic::ToolFrame& frame, std::int64_t now_ns) {
  if (pose_.seq > 0) {
    given_j_ += exerted_.force.dot(frame.p_WT - frame_.p_WT) +
                exerted_.torque.dot(haptic::rotation_between(frame_.q_WT, frame.q_WT));
    most_given_j_ = std::max(most_given_j_, given_j_);
    most_put_in_j_ = std::max(most_put_in_j_, -given_j_);
  }
  frame_ = frame;
  ++pose_.seq;
  pose_.stamp_ns = now_ns;
  pose_.position = node::to_message(frame.p_WT);
  const Eigen::Quaterniond& q = frame.q_WT;
  pose_.orientation = {q.w(), q.x(), q.y(), q.z()};
  static_cast<void>(line_.hear(pose_, now_ns));
  haptic::ToolInput input;
  static_cast<void>(line_.listen(now_ns, input));
  return input;
}

void HandLine::answer(const haptic::ToolOutput& output, std::int64_t now_ns) {
  line_.answer(output, now_ns, period_s_, false);
  const msg::ToolForce& force = line_.to_send(pose_.seq);
  altered_ += force.state != 0;
  line_.sent(true);
  static_cast<void>(hold_.take(force, now_ns));
}

}  // namespace omentum::haptic_test
