#include "ros_bridge/crtk.h"

#include <algorithm>
#include <cctype>

namespace omentum::ros {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

Header header(bool valid, std::int64_t at_ns, std::string& frame) {
  Header header{};
  header.frame_id_ = frame.data();
  if (!valid) return header;
  header.stamp_.sec_ = static_cast<std::int32_t>(at_ns / kNsPerS);
  header.stamp_.nanosec_ = static_cast<std::uint32_t>(at_ns % kNsPerS);
  return header;
}

bool is_valid(const msg::ToolPose* pose) {
  return pose != nullptr && pose->valid;
}

Pose pose_of(const msg::ToolPose& pose) {
  return {{pose.position.x, pose.position.y, pose.position.z},
          {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w}};
}

// a rotation, where there is none to tell
Pose no_pose() {
  return {{}, {0, 0, 0, 1}};
}

geometry_msgs_msg_dds__Vector3_ vector(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

PoseStamped measured_cp(const ToolNow& tool, std::string& frame) {
  const bool valid = is_valid(tool.pose);
  return {header(valid, tool.pose_ns, frame), valid ? pose_of(*tool.pose) : no_pose()};
}

CartesianState measured_cs(const ToolNow& tool, std::string& frame) {
  const bool valid = is_valid(tool.pose);
  CartesianState state{};
  state.header_ = header(valid, tool.pose_ns, frame);
  state.pose_ = valid ? pose_of(*tool.pose) : no_pose();
  if (valid) state.twist_ = {vector(tool.pose->linear_velocity), vector(tool.pose->angular_velocity)};
  state.pose_is_valid_.data_ = state.twist_is_valid_.data_ = valid;
  return state;
}

WrenchStamped servo_cf(const ToolNow& tool, std::string& frame) {
  WrenchStamped stamped{header(tool.force != nullptr, tool.force_ns, frame), {}};
  if (tool.force) stamped.wrench_ = {vector(tool.force->force), vector(tool.force->torque)};
  return stamped;
}

Operating operating(const ToolNow& tool) {
  if (!tool.force) return Operating::kDisabled;
  if ((tool.force->state & msg::FORCE_FAULT) != 0) return Operating::kFault;
  if (!is_valid(tool.pose)) return Operating::kDisabled;
  return (tool.force->state & msg::FORCE_PAUSED) != 0 ? Operating::kPaused : Operating::kEnabled;
}

const char* word(Operating state) {
  switch (state) {
    case Operating::kEnabled:
      return "ENABLED";
    case Operating::kPaused:
      return "PAUSED";
    case Operating::kFault:
      return "FAULT";
    case Operating::kDisabled:
      break;
  }
  return "DISABLED";
}

OperatingState operating_state(Operating state, bool homed, std::int64_t at_ns, std::string& frame) {
  // the message's texts are char pointers without const; nobody writes through them
  return {header(true, at_ns, frame), const_cast<char*>(word(state)), homed, false};
}

std::optional<std::uint32_t> command_of(const std::string& state_command, Operating state) {
  if (state_command == "pause" && state == Operating::kEnabled) return msg::COMMAND_PAUSE;
  if (state_command == "resume" && state == Operating::kPaused) return msg::COMMAND_START;
  if (state_command == "enable" && state == Operating::kFault) return msg::COMMAND_CLEAR_FAULT;
  return std::nullopt;
}

bool is_namespace(const std::string& text) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::ranges::all_of(text, fits);
}

}  // namespace omentum::ros
