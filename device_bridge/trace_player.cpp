#include "device_bridge/trace_player.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace omentum::device {
namespace {

// What the recorded hand would have accepted is unknown: limits that leave the scene's own ones in force.
constexpr double kMaxTraceForce_n = 50;
constexpr double kMaxTraceTorque_nm = 5;
constexpr double kMaxTraceStiffness_n_m = 10'000;

}  // namespace

TracePlayer::TracePlayer(std::uint32_t tool, Trace trace, double rate_hz)
    : tool_(tool), trace_(std::move(trace)), period_s_(1 / rate_hz) {}

msg::DeviceInfo TracePlayer::info() const {
  Vec3 low = trace_.front().position, high = low;
  for (const TracePoint& point : trace_) {
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  msg::DeviceInfo info;
  info.tool = tool_;
  info.name = "trace";
  info.max_force_n = kMaxTraceForce_n;
  info.max_torque_nm = kMaxTraceTorque_nm;
  info.max_stiffness_n_m = kMaxTraceStiffness_n_m;
  info.workspace_min = to_message(low);
  info.workspace_max = to_message(high);
  info.sensed_axes = msg::AXIS_X | msg::AXIS_Y | msg::AXIS_Z | msg::AXIS_PITCH | msg::AXIS_YAW |
                     msg::AXIS_ROLL | msg::AXIS_GRIP;
  return info;
}

void TracePlayer::command(const Wrench& wrench) noexcept {
  peak_force_n_ = std::max(peak_force_n_, wrench.force.norm());
}

Measurement TracePlayer::measure(std::int64_t now_ns) noexcept {
  Measurement measured = trace_at(trace_, trace_.front().t_s + static_cast<double>(played_) * period_s_);
  measured.measured_ns = now_ns;
  if (paused_) {
    measured.linear_velocity.setZero();
    measured.angular_velocity.setZero();
  } else {
    ++played_;
  }
  return measured;
}

nlohmann::json TracePlayer::report() const {
  return {{"peak_force_n", peak_force_n_}};
}

}  // namespace omentum::device
