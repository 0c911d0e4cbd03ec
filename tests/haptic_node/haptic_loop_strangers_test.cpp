// What strangers tell on the topics, and what haptic_node's loop makes of it: nothing takes a hand's force
// away, and nothing lifts a device's limits.
#include "tests/haptic_node/haptic_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::haptic {
namespace {

using haptic_test::HapticLoopTest;
using haptic_test::kAbove;
using haptic_test::kPressed;
using haptic_test::kRate_hz;
using haptic_test::kRelative;
using haptic_test::newton;
using haptic_test::Node;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::uint32_t kProbe = 1u << 0, kGrasper = 1u << 3;
constexpr int kSettledTicks = 5500;  // half a second more than node::kSettled_s
constexpr transport::WriterId kStranger{0x77};
// Weaker than the block when it is pressed.
constexpr double kWeak_n = 0.05;

class HapticStrangersTest : public HapticLoopTest {
 protected:
  /// As long as it takes, poses at `tip` and ten times a second the status of another haptic_node, older than
  /// any, for `tools`.
  void hold_beside_another(Node& node, const Vec3& tip, std::uint32_t tools, int ticks) {
    msg::NodeStatus other{};
    other.kind = msg::NODE_HAPTIC;
    other.instance = 1;
    other.tools_served = tools;
    other.rate_hz = kRate_hz;
    other.ticks = 1'000'000'000;
    other.host = "elsewhere";
    for (int i = 0; i < ticks / 100; ++i) {
      other.ticks += 100;
      bus_.post(other);
      hold(node, tip, 100);
    }
  }
  double felt_n(Node& node) {
    hold(node, kPressed, 100);
    return newton(*bus_.newest<msg::ToolForce>());
  }
};

msg::DeviceInfo device_of(double force_n, double stiffness_n_m = 1000) {
  msg::DeviceInfo info{};
  info.max_force_n = force_n;
  info.max_torque_nm = 1;
  info.max_stiffness_n_m = stiffness_n_m;
  return info;
}

TEST_F(HapticStrangersTest, WhoListensLeavesItsToolsToWhoServesThem) {
  bus_.watch<msg::ToolForce>();
  const auto node = start();
  hold_beside_another(*node, kAbove, kProbe | kGrasper, 900);
  EXPECT_THAT(node->end(), AllOf(HasSubstr("already served"), HasSubstr("elsewhere")));
}

// A tool in dispute is one tool: the others go on.
TEST_F(HapticStrangersTest, AYoungNodeLeavesToAnotherOnlyTheToolThatIsInDispute) {
  const auto node = pressing();
  const double pressed = felt_n(*node);
  hold_beside_another(*node, kPressed, kGrasper, 1000);
  const auto status = bus_.newest<msg::NodeStatus>();
  EXPECT_EQ(status->tools_served, kProbe);
  EXPECT_THAT(status->faults, Contains(StartsWith("tool 3: left to another")));
  EXPECT_NEAR(felt_n(*node), pressed, 1e-3 * pressed);
  EXPECT_EQ(node->end(), "");
}

TEST_F(HapticStrangersTest, NoStatusTakesAToolFromASettledNode) {
  const auto node = serving();
  hold(*node, kAbove, kSettledTicks);
  move(*node, kAbove, kPressed);
  hold(*node, kPressed, 300);
  const double pressed = felt_n(*node);
  hold_beside_another(*node, kPressed, kProbe | kGrasper, 1000);
  EXPECT_NEAR(felt_n(*node), pressed, 1e-3 * pressed);
  const auto status = bus_.newest<msg::NodeStatus>();
  EXPECT_EQ(status->tools_served, kProbe | kGrasper);
  EXPECT_THAT(status->faults, Contains(StartsWith("tool 0: another haptic_node claims it")));
  EXPECT_EQ(node->end(), "");
}

TEST_F(HapticStrangersTest, AnotherOrganFileIsRefusedWithBothHashes) {
  const auto node = start();
  hold(*node, kAbove, 500);
  bus_.post(block().info("abc"));
  EXPECT_FALSE(node->tick());
  EXPECT_THAT(node->end(), AllOf(HasSubstr("abc"), HasSubstr(block().organ_hash())));
}

TEST_F(HapticStrangersTest, AStrangersSceneDoesNotEndAPress) {
  const auto node = pressing();
  hold(*node, kPressed, kSettledTicks);
  const double pressed = felt_n(*node);
  bus_.post(block().info("abc"));
  EXPECT_NEAR(felt_n(*node), pressed, 1e-3 * pressed);
  EXPECT_THAT(faults(), Contains(StartsWith("scene: a deform_node with other organs")));
  EXPECT_EQ(node->end(), "");
}

TEST_F(HapticStrangersTest, ADevicesLimitOutlivesNonsense) {
  const auto node = serving();
  bus_.post(device_of(kWeak_n));
  for (const double nonsense : {std::nan(""), -1.0, HUGE_VAL}) bus_.post(device_of(nonsense));
  bus_.post(device_of(kWeak_n, 5e-324));
  move(*node, kAbove, kPressed);
  hold(*node, kPressed, 300);
  const auto force = bus_.newest<msg::ToolForce>();
  EXPECT_TRUE(force->state & msg::FORCE_CLAMPED);
  EXPECT_NEAR(newton(*force), kWeak_n, kWeak_n * kRelative);
  EXPECT_THAT(faults(), AllOf(Contains(StartsWith("tool 0: DeviceInfo.max_force_n = nan")),
                              Contains(StartsWith("tool 0: DeviceInfo.max_stiffness_n_m"))));
}

TEST_F(HapticStrangersTest, AnotherDeviceInfoMayTightenALimitAndNeverLiftsIt) {
  bus_.post(device_of(kWeak_n));
  const auto node = pressing();
  EXPECT_NEAR(felt_n(*node), kWeak_n, kWeak_n * kRelative);
  for (const auto& [stranger_n, held_n] :
       {std::pair(10.0, kWeak_n), std::pair(kWeak_n / 2, kWeak_n / 2), std::pair(10.0, kWeak_n)}) {
    bus_.post(device_of(stranger_n), kStranger);
    EXPECT_NEAR(felt_n(*node), held_n, held_n * kRelative);
  }
  bus_.post(device_of(kWeak_n / 2), kStranger);
  EXPECT_NEAR(felt_n(*node), kWeak_n / 2, kWeak_n * kRelative);
  bus_.leave<msg::DeviceInfo>(kStranger);
  EXPECT_NEAR(felt_n(*node), kWeak_n, kWeak_n * kRelative);
}

TEST_F(HapticStrangersTest, PosesOfAToolThatTheSceneDoesNotHaveChangeNothing) {
  const auto node = serving();
  const std::uint64_t woken = node->pace().woken();
  msg::ToolPose pose = pose_at(*node, kPressed);
  pose.tool = 5;
  bus_.post(pose);
  node->tick();
  EXPECT_EQ(node->pace().woken(), woken);
}

}  // namespace
}  // namespace omentum::haptic
