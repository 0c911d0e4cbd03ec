// Everything that stands between what a device measures and exerts, and the tool in the scene.
#pragma once

#include "device_bridge/device.h"
#include "device_bridge/frames/base_frame.h"
#include "device_bridge/frames/clutch.h"
#include "device_bridge/frames/engagement.h"
#include "device_bridge/frames/trocar_lever.h"

#include <cstdint>
#include <optional>

namespace omentum::device {

/// One device's.
struct MappingSpec {
  BaseFrame base{};
  double force_scale = 1;                        // more or less than what does the tool's work; above 0
  std::optional<TrocarLever> lever{};            // the hand holds the handle; else the tip itself
  std::optional<std::uint32_t> clutch_button{};  // which of the device's, 1 to 31
  std::optional<std::uint32_t> enable_button{};  // a dead man's: who lets go of it lets go of the tool
};

/// What a hand measures as the tool's pose in W, and back for a handle that points along its shaft: what
/// HandMapping does without a clutch. For simulated hands, which want to be somewhere with the tip.
Measurement tool_of(const MappingSpec& spec, const Measurement& hand) noexcept;
Measurement hand_of(const MappingSpec& spec, const Measurement& tool) noexcept;

/// hand -> base -> clutch -> lever -> tool, and wrenches the same way back, by the transposes of what
/// velocities go through: the hand's power is force_scale times the tool's, whatever is configured. While the
/// clutch is held, the enable button is not, or the pose is none, the hand is let go of within
/// Engagement::kLetGo_s, and takes hold in kTakeHold_s after that. Where neither buttons nor a lever are
/// configured nothing fades. Reads no clock, allocates nothing. One thread.
class HandMapping {
 public:
  explicit HandMapping(const MappingSpec& spec = {}) : spec_(spec) {}

  /// The tool's pose in W, of a device's valid measurement in its own frame. Not valid where nobody holds the
  /// enable button, or the handle does not go through the trocar (off_trocar()).
  Measurement to_tool(const Measurement& hand) noexcept;
  /// There was no measurement that could be used.
  void lose() noexcept { holds_ = false; }

  /// What the hand must feel, in the device's frame, where it was last; dt_s: since the last call.
  Wrench to_hand(const Wrench& at_tool, double dt_s) noexcept;
  /// Whether anything is felt of it: 0 to 1.
  double share() const noexcept { return fades() ? engagement_.share() : 1; }
  bool off_trocar() const noexcept { return off_trocar_; }

  /// What the device is for the tool: limits at a lever's most unfavourable place. Axes stay the device's
  /// own. Throws std::runtime_error where so little of the device's stiffness is left that haptic_node would
  /// not believe it.
  msg::DeviceInfo describe(msg::DeviceInfo hand) const;

 private:
  bool fades() const noexcept { return spec_.clutch_button || spec_.enable_button || spec_.lever; }

  MappingSpec spec_;
  Clutch clutch_;
  Engagement engagement_;
  Measurement held_;    // the newest that moves the tool: in W where the hand holds it, after the clutch
  bool known_ = false;  // there was one
  bool holds_ = false;  // it is of now
  bool off_trocar_ = false;
};

}  // namespace omentum::device
