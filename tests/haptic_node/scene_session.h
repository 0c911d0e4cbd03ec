// A scene's simulated hands at their tissue, on one injected clock: all that stands between is the product's
// own code, but for the wire, which loses nothing.
#pragma once

#include "device_bridge/tool_channel.h"
#include "device_bridge/virtual_hand.h"
#include "haptic_node/haptic_setup.h"
#include "haptic_node/haptic_step.h"
#include "haptic_node/tool_line.h"

#include <memory>
#include <optional>
#include <vector>

namespace omentum::haptic_test {

/// scenes/liver.toml with its phantom of `young_pa`, made ready by scene_prepare as launch_scripts/run does.
/// Nothing where the phantom's program is absent.
std::optional<scene::Scene> liver_scene(double young_pa);

/// What hands got for what they put in, J.
struct EnergyAccount {
  /// What may have been given, as a share of the most that had been put in until then.
  static constexpr double kGain = 0.01;

  double given_j = 0;                     // in all, less what was put in ...
  double most_given_j = 0, put_in_j = 0;  // ... the most of it at any time, and of its negative
  double excess_j = 0;                    // the most that kGain did not allow
  double turned_over_j = 0;               // of all ways' amounts: what rounding is a share of

  void add(double work_j);
};

/// A simulated hand and what it really got: the commanded force is constant over its period, so that force
/// times way is its work.
class CountedHand : public device::Device {
 public:
  CountedHand(const scene::HandSpec& hand, const scene::ToolSpec& tool, double rate_hz)
      : hand_(hand, tool, rate_hz) {}

  msg::DeviceInfo info() const override { return hand_.info(); }
  void command(const device::Wrench& wrench) noexcept override;
  device::Measurement measure(std::int64_t now_ns) noexcept override;
  bool simulates() const noexcept override { return hand_.simulates(); }
  nlohmann::json report() const override { return hand_.report(); }

  const EnergyAccount& energy() const { return energy_; }

 private:
  device::VirtualHand hand_;
  device::Vec3 force_ = device::Vec3::Zero();
  std::optional<device::Vec3> tip_;
  EnergyAccount energy_;
};

/// Devices and haptic_node at one rate, without their processes.
class SceneSession {
 public:
  /// The scene names its organ file.
  SceneSession(const scene::Scene& scene, double rate_hz);

  /// Until every hand has played its script.
  void run();

  std::size_t hand_count() const { return hands_.size(); }
  const CountedHand& hand(std::size_t h) const { return *hands_[h]->counted; }
  const device::ToolChannel& channel(std::size_t h) const { return *hands_[h]->channel; }
  /// Of all hands' sum.
  const EnergyAccount& together() const { return together_; }
  std::uint64_t ticks() const { return ticks_; }
  std::vector<std::string> faults() const { return faults_.lines(); }

 private:
  struct Hand {
    std::size_t tool;  // of the model
    const CountedHand* counted;
    std::unique_ptr<device::ToolChannel> channel;
    std::unique_ptr<haptic::ToolLine> line;
  };

  void add_hand(const scene::Scene& scene, const scene::HandSpec& spec);
  void tick(std::int64_t now_ns);

  double rate_hz_, seconds_ = 0;
  haptic::HapticSetup setup_;
  haptic::HapticState state_;
  haptic::HapticWorkspace work_;
  runtime::FaultList faults_;
  std::vector<std::unique_ptr<Hand>> hands_;
  std::vector<haptic::ToolInput> inputs_;
  std::vector<haptic::ToolOutput> outputs_;
  EnergyAccount together_;
  std::uint64_t ticks_ = 0;
};

}  // namespace omentum::haptic_test
