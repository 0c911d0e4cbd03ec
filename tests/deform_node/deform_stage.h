// deform_node's loop on a scripted bus, and what its neighbours say to it.
#pragma once

#include "deform_node/deform_loop.h"

#include "tests/deform_node/deform_push.h"
#include "tests/deform_node/rates.h"
#include "tests/support/block_scene.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gtest/gtest.h>

namespace omentum::deform_test {

using deform::kRate_hz;
inline constexpr double kListens_s = 1;
inline constexpr double kSettled_s = 5.5;  // half a second more than node::kSettled_s

class DeformLoopTest : public testing::Test {
 protected:
  using Node = test::StagedLoop<deform::DeformLoop>;

  static const test::BlockScene& block() {
    static const test::BlockScene scene(4);
    return scene;
  }
  static const organ::Organ& organ() {
    static const organ::Organ organ = block().organ();
    return organ;
  }

  std::unique_ptr<Node> start() {
    deform::DeformOptions options;
    options.node.scene = block().scene();
    return std::make_unique<Node>(kRate_hz, options, bus_.opener());
  }
  /// One that has served for a tick.
  std::unique_ptr<Node> serving() {
    auto node = start();
    node->pass(kListens_s);
    return node;
  }
  /// The state of the next tick.
  msg::OrganState next_state(Node& node) {
    bus_.take_all<msg::OrganState>();
    node.tick();
    const auto states = bus_.take_all<msg::OrganState>();
    EXPECT_EQ(states.size(), 1u);
    return states.empty() ? msg::OrganState{} : states.front();
  }
  void command(std::uint32_t command) {
    bus_.post(msg::SessionCommand{.order = ++commands_, .sender = 1, .command = command, .argument = {}});
  }
  msg::NodeStatus status_of(std::uint32_t kind, std::uint64_t instance) {
    msg::NodeStatus status{};
    status.kind = kind;
    status.instance = instance;
    status.rate_hz = kRate_hz;
    return status;
  }
  /// A second in which another deform_node, older than any, tells ten times that it serves.
  void pass_beside_another(Node& node) {
    for (int i = 0; i < 10; ++i) {
      other_.ticks += 10;
      bus_.post(other_);
      node.tick(10);
    }
  }

  test::FakeBus bus_;
  std::uint64_t commands_ = 0;
  msg::NodeStatus other_ = status_of(msg::NODE_DEFORM, 1);
};

}  // namespace omentum::deform_test
