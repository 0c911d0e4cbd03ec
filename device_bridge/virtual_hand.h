// A simulated hand on a simulated device: moves by its script and yields to the force that it feels.
#pragma once

#include "device_bridge/device.h"
#include "device_bridge/frames/hand_mapping.h"
#include "device_bridge/hand_script.h"
#include "scene/scene.h"

#include <optional>

namespace omentum::device {

/// The hand's motion is integrated, not played: the loop hand - node - hand is closed physically, so that an
/// unstable force would be seen as an oscillation. Time advances by one period per measure(). The mass is
/// where the hand holds the instrument: with a mapping it measures and feels on the hand's side of it, and
/// wants to be where the tip follows the script.
class VirtualHand : public Device {
 public:
  VirtualHand(const scene::HandSpec& hand, const scene::ToolSpec& tool, double rate_hz,
              const std::optional<MappingSpec>& mapping = {});

  msg::DeviceInfo info() const override;
  void command(const Wrench& wrench) noexcept override { wrench_ = wrench; }
  Measurement measure(std::int64_t now_ns) noexcept override;
  bool simulates() const noexcept override { return true; }

  /// The target comes to rest, or goes on, within a tenth of a second.
  void pause(bool paused) noexcept override { paused_ = paused; }
  /// The target glides back to the start of its script.
  void restart() noexcept override;

  /// {"tool", "peak_force_n", "peak_grip_torque_nm", "mean_force_n", "hold_force_n", "deepest_target_m",
  /// "deepest_tip_m"}: the mean while the target is below the rest surface; "hold_force_n" the mean over the
  /// second halves of the holds, the steady force; depths below the rest surface along the press normal.
  nlohmann::json report() const override;

 private:
  struct Mean {
    double sum = 0;
    std::uint64_t count = 0;
    void add(double value) { sum += value, ++count; }
    double value() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
  };

  Motion advance_target(double dt_s) noexcept;
  Motion hand_at(const Motion& tip) const noexcept;
  Motion tip_at(const Motion& hand) const noexcept;
  Quat orientation() const noexcept;
  void record() noexcept;

  scene::HandSpec hand_;
  scene::ToolSpec tool_;
  double period_s_;
  int substeps_;
  std::optional<MappingSpec> mapping_;
  ScriptPoint script_;
  Motion target_, tip_;  // in W
  Motion held_;          // what has the mass, in the device's frame
  Quat orientation_;
  Wrench wrench_;
  bool paused_ = false;
  double pace_ = 1;                  // of the script: 0 at rest, 1 at its own speed
  double script_s_ = 0;              // script time
  double return_s_ = 0;              // since restart()
  Vec3 return_from_ = Vec3::Zero();  // the target at restart() relative to the script's start
  double peak_force_n_ = 0, peak_grip_torque_nm_ = 0, deepest_target_m_ = 0, deepest_tip_m_ = 0;
  Mean press_force_n_, hold_force_n_;
};

}  // namespace omentum::device
