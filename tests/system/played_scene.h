// A scene's simulated hands, haptic_node and deform_node on one scripted bus: a session without processes and
// without pictures, in which a second passes as fast as it can be computed.
#pragma once

#include "deform_node/deform_loop.h"
#include "device_bridge/device_bridge.h"
#include "device_bridge/virtual_hand.h"
#include "haptic_node/haptic_loop.h"

#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace omentum::test {

/// What one tool's hand felt in a tick.
struct FeltTick {
  geometry::Vec3 force = geometry::Vec3::Zero();  // N
  double grip_torque_nm = 0;
};

class PlayedScene {
 public:
  static constexpr double kHand_hz = 1000, kOrgan_hz = 100;

  /// Of a scene whose organs have files; its script is `scene.hands`.
  explicit PlayedScene(const scene::Scene& scene)
      : hand_(kHand_hz, hand_options(scene), bus_.opener()),
        organ_(kOrgan_hz, organ_options(scene), bus_.opener()),
        device_(kHand_hz, device::BridgeOptions{}, devices_of(scene), bus_.opener()) {}

  /// One millisecond.
  void tick() {
    device_.tick();
    hand_.tick();
    if (++ticks_ % kOrganEvery == 0 && organ_ticks_taken_-- <= 0) organ_.tick();
    for (const msg::ToolForce& force : bus_.take_all<msg::ToolForce>()) {
      FeltTick& felt = felt_[force.tool];
      const geometry::Vec3 now(force.force.x, force.force.y, force.force.z);
      largest_step_n_ = std::max(largest_step_n_, (now - felt.force).norm());
      felt = {now, force.grip_torque};
    }
    for (msg::Topology& topology : bus_.take_all<msg::Topology>()) topology_ = std::move(topology);
    bus_.take_all<msg::ToolPose>(), bus_.take_all<msg::Contact>(), bus_.take_all<msg::LocalModel>();
  }
  void play(double seconds) {
    for (int i = 0; i < std::lround(seconds * kHand_hz); ++i) tick();
  }

  /// A busy machine takes the organ's next ticks away.
  void take_organ_ticks(int count) {
    organ_.pace().stall(std::llround(1e9 * count / kOrgan_hz));
    organ_ticks_taken_ = count;
  }

  double seconds() const { return static_cast<double>(ticks_) / kHand_hz; }
  const FeltTick& felt(std::uint32_t tool) const { return felt_.at(tool); }
  /// Of the force on any hand from one tick to the next, N.
  double largest_step_n() const { return largest_step_n_; }
  const std::optional<msg::Topology>& topology() const { return topology_; }
  /// The newest one, in one block.
  std::optional<msg::OrganState> state() { return bus_.newest<msg::OrganState>(); }
  FakeBus& bus() { return bus_; }

  nlohmann::json hand_report() {
    EXPECT_EQ(hand_.end(), "");
    return hand_.loop().report();
  }
  nlohmann::json organ_report() {
    EXPECT_EQ(organ_.end(), "");
    return organ_.loop().report();
  }
  nlohmann::json device_report() {
    EXPECT_EQ(device_.end(), "");
    return device_.loop().report();
  }

 private:
  static constexpr std::uint64_t kOrganEvery = 10;

  static haptic::HapticOptions hand_options(const scene::Scene& scene) {
    haptic::HapticOptions options;
    options.node.scene = scene.file;
    options.rate_hz = kHand_hz;
    return options;
  }
  static deform::DeformOptions organ_options(const scene::Scene& scene) {
    deform::DeformOptions options;
    options.node.scene = scene.file;
    options.rate_hz = kOrgan_hz;
    return options;
  }
  static std::vector<std::unique_ptr<device::Device>> devices_of(const scene::Scene& scene) {
    std::vector<std::unique_ptr<device::Device>> devices;
    for (const scene::HandSpec& hand : scene.hands)
      devices.push_back(std::make_unique<device::VirtualHand>(hand, scene.tools.at(hand.tool), kHand_hz));
    return devices;
  }

  FakeBus bus_;
  StagedLoop<haptic::HapticLoop> hand_;
  StagedLoop<deform::DeformLoop> organ_;
  StagedLoop<device::DeviceBridge> device_;
  std::uint64_t ticks_ = 0;
  int organ_ticks_taken_ = 0;
  std::array<FeltTick, msg::MAX_TOOLS> felt_{};
  double largest_step_n_ = 0;
  std::optional<msg::Topology> topology_;
};

}  // namespace omentum::test
