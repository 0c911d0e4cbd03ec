// haptic_node's loop on a scripted bus, and a device of the test's that speaks once in each tick.
#pragma once

#include "haptic_node/haptic_loop.h"

#include "tests/haptic_node/haptic_block.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gtest/gtest.h>

#include <cmath>

namespace omentum::haptic_test {

using geometry::Vec3;
using Node = test::StagedLoop<haptic::HapticLoop>;

inline constexpr double kRate_hz = 1000;
inline constexpr double kListens_s = 1;
inline double newton(const msg::ToolForce& force) {
  return vector(force.force).norm();
}

/// A block, a probe (tool 0), which the device holds, and a grasper (tool 3), which nobody does.
class HapticLoopTest : public testing::Test {
 protected:
  static const test::BlockScene& block() {
    static const test::BlockScene scene = block_scene();
    return scene;
  }

  std::unique_ptr<Node> start(double rate_hz = kRate_hz) {
    options_.node.scene = block().scene();
    options_.rate_hz = rate_hz;
    return std::make_unique<Node>(rate_hz, options_, bus_.opener());
  }
  /// It has listened, and the device's forces have faded in.
  std::unique_ptr<Node> serving(double rate_hz = kRate_hz) {
    auto node = start(rate_hz);
    hold(*node, kAbove, static_cast<int>((kListens_s + 0.3) * rate_hz));
    return node;
  }
  /// The tip is at kPressed, and what it feels is the model's own force.
  std::unique_ptr<Node> pressing(double rate_hz = kRate_hz) {
    auto node = serving(rate_hz);
    move(*node, kAbove, kPressed);
    hold(*node, kPressed, static_cast<int>(0.3 * rate_hz));
    return node;
  }

  msg::ToolPose pose_at(const Node& node, const Vec3& tip) {
    msg::ToolPose pose{};
    pose.seq = ++seq_;
    pose.stamp_ns = node.pace().now_ns();
    pose.valid = true;
    pose.position = {.x = tip.x(), .y = tip.y(), .z = tip.z()};
    pose.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
    return pose;
  }
  void hold(Node& node, const Vec3& tip, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      bus_.post(pose_at(node, tip));
      if (!node.tick()) return;
    }
  }
  /// In steps of 0.2 mm.
  void move(Node& node, const Vec3& from, const Vec3& to) {
    const int steps = static_cast<int>(std::ceil((to - from).norm() / 2e-4));
    for (int i = 1; i <= steps; ++i) hold(node, from + (to - from) * i / steps, 1);
  }
  void command(std::uint32_t command) {
    bus_.post(msg::SessionCommand{.order = ++commands_, .sender = 1, .command = command, .argument = {}});
  }

  /// The newest that was not consumed; consumes the others too.
  template <class M>
  std::optional<M> last_of_tool(std::uint32_t tool) {
    std::optional<M> last;
    for (const M& sample : bus_.take_all<M>())
      if (sample.tool == tool) last = sample;
    return last;
  }
  /// What the newest status lists.
  std::vector<std::string> faults() { return bus_.newest<msg::NodeStatus>()->faults; }

  test::FakeBus bus_;
  haptic::HapticOptions options_;
  std::uint64_t seq_ = 0, commands_ = 0;
};

}  // namespace omentum::haptic_test
