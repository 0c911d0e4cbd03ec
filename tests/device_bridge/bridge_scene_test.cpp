// Hands in a session whose scene is not theirs, on a scripted bus.
#include "device_bridge/device_bridge.h"
#include "device_bridge/virtual_hand.h"
#include "node_common/rivals.h"

#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::device {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::StartsWith;

constexpr double kRate_hz = 1000;
constexpr double kLongAgo_s = node::kSettled_s + 1;

scene::Scene a_scene(double young_pa) {
  scene::Scene scene;
  scene.organs.resize(1);
  scene.organs[0].young_pa = young_pa;
  return scene;
}

msg::SceneInfo announced(double young_pa) {
  return node::to_message(node::loaded_scene(a_scene(young_pa), {{.name = "liver", .hash = "aaaa"}}), "s");
}

class BridgeSceneTest : public testing::Test {
 protected:
  using Node = test::StagedLoop<DeviceBridge>;

  /// A hand of `scene`; of none: a device that is at home everywhere.
  std::unique_ptr<Node> start(const std::optional<scene::Scene>& scene) {
    BridgeOptions options;
    if (scene) options.scene = node::loaded_scene(*scene, {});
    std::vector<std::unique_ptr<Device>> devices;
    devices.push_back(std::make_unique<VirtualHand>(scene::HandSpec{}, scene::ToolSpec{}, kRate_hz));
    return std::make_unique<Node>(kRate_hz, options, std::move(devices), bus_.opener());
  }
  std::vector<std::string> faults() { return bus_.newest<msg::NodeStatus>()->faults; }

  test::FakeBus bus_;
};

TEST_F(BridgeSceneTest, AnotherSceneIsRefusedWithTheFirstValueThatDiffers) {
  const auto node = start(a_scene(6000));
  ASSERT_TRUE(node->pass(1));
  bus_.post(announced(12000));
  EXPECT_FALSE(node->pass(1));
  EXPECT_EQ(node->end(), "scene: organs[0].young_pa is 12000 at deform_node, 6000 here");
}

TEST_F(BridgeSceneTest, ItsOwnSceneIsPlayed) {
  bus_.post(announced(6000));
  const auto node = start(a_scene(6000));
  EXPECT_TRUE(node->pass(kLongAgo_s));
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_EQ(node->end(), "");
}

TEST_F(BridgeSceneTest, OnceSettledTheOtherSceneIsAFault) {
  const auto node = start(a_scene(6000));
  ASSERT_TRUE(node->pass(kLongAgo_s));
  bus_.post(announced(12000));
  EXPECT_TRUE(node->pass(1));
  EXPECT_THAT(faults(), Contains(StartsWith(node::kForeignScene)));
  EXPECT_EQ(node->end(), "");
}

TEST_F(BridgeSceneTest, ADeviceWithoutASceneJoinsEverySession) {
  bus_.post(announced(12000));
  const auto node = start(std::nullopt);
  EXPECT_TRUE(node->pass(1));
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_EQ(node->end(), "");
}

}  // namespace
}  // namespace omentum::device
