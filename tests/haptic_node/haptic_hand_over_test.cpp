// A tool that goes from one device to another: who is felt, what both hands feel on the way, and who is told.
#include "haptic_node/hand_over_log.h"
#include "tests/haptic_node/haptic_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::haptic {
namespace {

using haptic_test::HapticLoopTest;
using haptic_test::kAbove;
using haptic_test::kPressed;
using haptic_test::newton;
using haptic_test::Node;
using haptic_test::vector;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

// participants, and of each a writer of poses and one of what it is
constexpr transport::WriterId kGuestPoses{0x21, 1}, kGuestInfo{0x21, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9},
    kWantedPoses{0x42, 1}, kWantedInfo{0x42, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9};
constexpr double kSlew_n_per_tick = 2;             // the scene's, which is haptic_node's default
constexpr std::uint64_t kGuestCounts = 1'000'000;  // from there

/// Tool 0 is for the device "omega".
class HandOverTest : public HapticLoopTest {
 protected:
  HandOverTest() {
    options_.node.scene = block().scene_with("name = \"probe\"", "name = \"probe\"\ndevice = \"omega\"");
  }
  std::unique_ptr<Node> node() {
    return std::make_unique<Node>(haptic_test::kRate_hz, options_, bus_.opener());
  }
  void introduce(const std::string& name, const transport::WriterId& writer) {
    msg::DeviceInfo info{};
    info.name = name;
    info.max_force_n = 10;
    info.max_torque_nm = 1;
    info.max_stiffness_n_m = 2000;
    bus_.post(info, writer);
  }
  /// Both in each tick, who has a place.
  void go(Node& node, int ticks, const std::optional<Vec3>& guest, const std::optional<Vec3>& wanted) {
    for (int i = 0; i < ticks; ++i) {
      if (guest) send(node, *guest, ++guest_seq_, kGuestPoses);
      if (wanted) send(node, *wanted, ++seq_, kWantedPoses);
      ASSERT_TRUE(node.tick());
      for (const msg::ToolForce& force : bus_.take_all<msg::ToolForce>()) hear(force);
    }
  }
  bool guest_is_felt() const { return newest_.echo_seq > kGuestCounts; }

  msg::ToolForce newest_{};
  double steepest_n_ = 0, largest_to_wanted_n_ = 0;

 private:
  void send(const Node& node, const Vec3& tip, std::uint64_t seq, const transport::WriterId& writer) {
    msg::ToolPose pose = pose_at(node, tip);
    --seq_;
    pose.seq = seq;
    bus_.post(pose, writer);
  }
  void hear(const msg::ToolForce& force) {
    if (force.tool != 0) return;
    const Vec3 change = vector(force.force) - vector(newest_.force);
    steepest_n_ = std::max(steepest_n_, change.norm());
    newest_ = force;
    if (!guest_is_felt()) largest_to_wanted_n_ = std::max(largest_to_wanted_n_, newton(force));
  }

  std::uint64_t guest_seq_ = kGuestCounts;
};

TEST_F(HandOverTest, TheScenesDeviceTakesThePressedToolAndNeitherHandIsStruck) {
  const auto node = this->node();
  introduce("guest", kGuestInfo);
  go(*node, 1300, kAbove, {});
  for (int i = 1; i <= 45; ++i) go(*node, 1, kAbove + (kPressed - kAbove) * i / 45, {});
  go(*node, 300, kPressed, {});
  ASSERT_TRUE(guest_is_felt());
  const double pressed_n = newton(newest_);
  ASSERT_GT(pressed_n, 0.1);

  introduce("omega", kWantedInfo);
  go(*node, 40, kPressed, kPressed);
  EXPECT_GT(newton(newest_), 0.9 * pressed_n) << "he is served until the other one has shown that it comes";
  go(*node, 30, kPressed, kPressed);
  EXPECT_TRUE(guest_is_felt()) << "the last force of the one that leaves is his";
  go(*node, 100, kPressed, kPressed);
  EXPECT_FALSE(guest_is_felt());
  EXPECT_LE(steepest_n_, kSlew_n_per_tick);
  EXPECT_LT(largest_to_wanted_n_, 0.1 * pressed_n) << "a hand that did not press begins with nothing";
  go(*node, 300, kPressed, kPressed);
  EXPECT_FALSE(guest_is_felt()) << "whoever else goes on moving it";
  EXPECT_THAT(faults(), testing::ElementsAre(HasSubstr("tool 0: pose refused: the tool is another")));
  EXPECT_EQ(node->end(), "");
  const nlohmann::json told = node->loop().report()["poses"][0]["hand_overs"];
  EXPECT_EQ(told, (nlohmann::json{{"count", 1}, {"from", "guest"}, {"to", "omega"}}));
}

TEST_F(HandOverTest, TheOthersAreNotHeardUntilTheScenesDeviceHasLeft) {
  const auto node = this->node();
  introduce("omega", kWantedInfo);
  introduce("guest", kGuestInfo);
  go(*node, 1300, kAbove, {});
  EXPECT_EQ(newest_.echo_seq, 0u) << "it is there, its hand rests";
  go(*node, 100, kAbove, kAbove);
  EXPECT_FALSE(guest_is_felt());
  EXPECT_GT(newest_.echo_seq, 0u);
  go(*node, 500, kAbove, {});
  EXPECT_FALSE(guest_is_felt());
  bus_.leave<msg::DeviceInfo>(kWantedInfo);
  go(*node, 100, kAbove, {});
  EXPECT_TRUE(guest_is_felt());
  EXPECT_EQ(node->end(), "");
}

TEST_F(HandOverTest, OneThatCountsHigherInTheSamePlaceDoesNotSlipIn) {
  const auto node = this->node();
  introduce("guest", kGuestInfo);
  introduce("another", kWantedInfo);  // which the scene does not want
  go(*node, 1300, {}, kAbove);
  ASSERT_GT(newest_.echo_seq, 0u);
  go(*node, 200, kAbove, kAbove);
  EXPECT_FALSE(guest_is_felt());
  EXPECT_EQ(node->end(), "");
}

TEST(HandOverLog, OneLineForEachAndOneASecondForTwoThatTakeTurns) {
  constexpr std::int64_t kTick_ns = 100'000'000;
  HandOverLog log;
  EXPECT_THAT(log.line(2, kTick_ns), IsEmpty());
  node::HandOver last{.count = 1, .at_ns = 0, .from = {'a', '\n'}, .to = {}};
  log.take(last);
  std::vector<std::string> told{log.line(2, 2 * kTick_ns)};
  EXPECT_EQ(told[0], "haptic_node: tool 2 goes from 'a\\x0a' to a device without a name");
  for (int i = 0; i < 20; ++i) {
    ++last.count;
    log.take(last);
    const std::string line = log.line(2, (3 + i) * kTick_ns);
    if (!line.empty()) told.push_back(line);
  }
  ASSERT_EQ(told.size(), 3u) << "of 21 in 2.1 s";
  EXPECT_THAT(told[1], EndsWith(" (11 hand-overs by now)"));
  EXPECT_EQ(log.report()["count"], 21);
}

}  // namespace
}  // namespace omentum::haptic
