#include "haptic_node/tool_line.h"

namespace omentum::haptic {
namespace {

msg::Vec3 to_message(const Vec3& v) {
  return {.x = v.x(), .y = v.y(), .z = v.z()};
}

}  // namespace

ToolFrame frame_of(const msg::ToolPose& pose) noexcept {
  const msg::Quat& q = pose.orientation;
  return {{pose.position.x, pose.position.y, pose.position.z},
          Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized()};
}

ToolLine::ToolLine(std::uint32_t id, const ForceLimits& limits, runtime::FaultList& faults)
    : id_(id), valid_for_s_(limits.stale_s), faults_(faults), safety_(limits) {
  const std::string tool = "tool " + std::to_string(id) + ": ";
  for (int v = 0; v < kPoseVerdicts; ++v) {
    refusals_[v] = tool + "pose refused: " + describe(static_cast<PoseVerdict>(v));
  }
  force_fault_ = tool + "force is not finite, held at zero until the fault is cleared";
}

bool ToolLine::hear(const msg::ToolPose& pose, std::int64_t now_ns) noexcept {
  if (forget_.exchange(false, std::memory_order_acquire)) guard_.forget();
  const PoseVerdict verdict = guard_.judge(pose, now_ns);
  lost_.store(guard_.lost(), std::memory_order_relaxed);
  if (!is_accepted(verdict)) {
    refused_.fetch_add(1, std::memory_order_relaxed);
    faults_.raise(refusals_[static_cast<std::size_t>(verdict)]);
    return false;
  }
  accepted_.fetch_add(1, std::memory_order_relaxed);
  if (verdict == PoseVerdict::kReconnected) ++connections_;
  poses_.post({pose, now_ns, connections_});
  return true;
}

void ToolLine::hear(const msg::DeviceInfo& info) noexcept {
  limits_.post({info.max_force_n, info.max_torque_nm});
}

PoseCounts ToolLine::counts() const noexcept {
  return {accepted_.load(std::memory_order_relaxed), refused_.load(std::memory_order_relaxed),
          lost_.load(std::memory_order_relaxed)};
}

bool ToolLine::listen(std::int64_t now_ns, ToolInput& input) noexcept {
  if (limits_.fetch()) safety_.set_device_limits(limits_.value().force_n, limits_.value().torque_nm);
  const bool fresh = poses_.fetch();
  const HeardPose& heard = poses_.value();
  reconnected_ = heard.connection != connection_;
  connection_ = heard.connection;
  engaged_ = heard.connection > 0 && now_ns - heard.arrival_ns < kLetGo_ns;
  input = {engaged_, reconnected_, frame_of(heard.pose), heard.pose.grip};
  return fresh;
}

const msg::ToolForce& ToolLine::answer(const ToolOutput& output, std::int64_t now_ns, double dt_s,
                                       bool paused) noexcept {
  const HeardPose& heard = poses_.value();
  SafetyInput input;
  input.model = {output.force, output.torque};
  input.stored_j = output.stored_j;
  input.tip = frame_of(heard.pose).p_WT;
  input.orientation = frame_of(heard.pose).q_WT;
  input.pose_age_s = 1e-9 * static_cast<double>(now_ns - heard.arrival_ns);
  input.dt_s = dt_s;
  input.engaged = engaged_;
  input.reconnected = reconnected_;
  input.paused = paused;
  const bool fault_before = safety_.faulted();
  const SafeForce safe = safety_.pass(input);
  if (safety_.faulted() && !fault_before) faults_.raise(force_fault_);

  force_.tool = id_;
  force_.echo_seq = heard.pose.seq;
  force_.echo_stamp_ns = heard.pose.stamp_ns;
  force_.force = to_message(safe.wrench.force);
  force_.torque = to_message(safe.wrench.torque);
  force_.grip_torque = 0;  // rigid jaws: the tissue between them does not push them open
  force_.valid_for_s = valid_for_s_;
  force_.state = safe.state;
  return force_;
}

const msg::ToolForce& ToolLine::to_send(std::uint64_t tick) noexcept {
  ++force_.seq;
  force_.tick = tick;
  return force_;
}

void ToolLine::restart() noexcept {
  safety_.restart();
}

msg::Echo ToolLine::echo() const noexcept {
  const HeardPose& heard = poses_.value();
  return {.tool = id_, .seq = heard.pose.seq, .stamp_ns = heard.pose.stamp_ns};
}

}  // namespace omentum::haptic
