// A tool in the words of CRTK: pure functions of what came over Omentum's topics.
#pragma once

#include "ros_bridge/wire/ros_types.h"
#include "transport/messages.h"

#include <cstdint>
#include <optional>
#include <string>

namespace omentum::ros {

/// What is known of a tool at one moment. Null: nothing came, or it is not of now (kFresh_s).
struct ToolNow {
  const msg::ToolPose* pose = nullptr;
  const msg::ToolForce* force = nullptr;
  std::int64_t pose_ns = 0, force_ns = 0;  // when they came, since 1970
};

/// Older than this a pose or force is none, s: long enough for an observer on a busy machine, who often gets
/// nothing for 25 ms. By its age alone a device that was killed is missed: no lease is requested.
inline constexpr double kFresh_s = 0.1;

/// Messages whose stamp is 0 where there is nothing valid. `frame` must outlive what is returned.
PoseStamped measured_cp(const ToolNow& tool, std::string& frame);
/// Pose and twist. What the device exerts nobody measures: the wrench is not valid.
CartesianState measured_cs(const ToolNow& tool, std::string& frame);
/// What the device's motors must exert on the hand at the tip, in W.
WrenchStamped servo_cf(const ToolNow& tool, std::string& frame);

/// FAULT: haptic_node has latched one, the force is zero until a person clears it. PAUSED: the session is.
/// ENABLED: the device measures, and forces answer it. DISABLED: one of them does not.
enum class Operating { kDisabled, kEnabled, kPaused, kFault };
Operating operating(const ToolNow& tool);
const char* word(Operating state);
/// As CRTK tells it; `homed`: the device measures. Nothing that a tool does here makes others wait, so that
/// it is never busy.
OperatingState operating_state(Operating state, bool homed, std::int64_t at_ns, std::string& frame);

/// The session's command (msg::COMMAND_*) that a state_command of CRTK asks for in `state`; none where it
/// changes nothing, is not of CRTK, or there is nothing like it: "disable" is what a device's own button
/// does. "enable" clears a latched fault.
std::optional<std::uint32_t> command_of(const std::string& state_command, Operating state);

/// A tool's namespace: letters, digits and underscores, not a digit first, as ROS has it.
bool is_namespace(const std::string& text);

}  // namespace omentum::ros
