// Who shows a tool shows the hand that holds it.
#include "node_common/held_tools.h"

#include "tests/support/fake_bus.h"

#include <gtest/gtest.h>

#include <map>

namespace omentum::node {
namespace {

constexpr transport::WriterId kGuest{0x21}, kWanted{0x42};
constexpr std::int64_t kPosePeriod_ns = 1'000'000;

class HeldToolsTest : public testing::Test {
 protected:
  static scene::Scene scene_for(const std::string& device) {
    scene::Scene scene;
    scene.tools.resize(2);
    scene.tools[1].id = 3;
    for (scene::ToolSpec& tool : scene.tools) tool.device = device;
    return scene;
  }
  void begin(const std::string& device) {
    bus_ = fake_.opener()();
    held_ = std::make_unique<HeldTools>(*bus_, scene_for(device));
    poses_ = std::make_unique<transport::LatestByTool<msg::ToolPose>>(
        *bus_, std::function<void(const msg::ToolPose&)>{}, [this] { return now_ns_; }, held_->admits());
  }
  void introduce(const std::string& name, const transport::WriterId& writer, std::uint32_t tool = 3) {
    msg::DeviceInfo info{};
    info.tool = tool;
    info.name = name;
    fake_.post(info, writer);
  }
  static msg::ToolPose well() {
    msg::ToolPose pose{};
    pose.valid = true;
    pose.orientation.w = 1;
    return pose;
  }
  /// Poses of tool 3 for so many ms; how far each of both is away is who he is.
  void go(int ms, std::initializer_list<transport::WriterId> writers, const msg::ToolPose& like = well()) {
    for (int i = 0; i < ms; ++i) {
      now_ns_ += kPosePeriod_ns;
      for (const transport::WriterId& writer : writers) {
        msg::ToolPose pose = like;
        pose.tool = 3;
        pose.seq = ++seq_[writer[0]];
        pose.stamp_ns = now_ns_;
        pose.position.x = writer[0];
        fake_.post(pose, writer);
      }
    }
  }
  /// haptic_node's answer to the newest pose.
  void answer(const transport::WriterId& writer) {
    msg::ToolForce force{};
    force.tool = 3;
    force.echo_seq = seq_[writer[0]];
    force.echo_stamp_ns = now_ns_;
    fake_.post(force);
  }
  std::optional<double> seen() {
    transport::Arrived<msg::ToolPose> pose;
    if (!poses_->load(3, pose) || pose.age_ns(now_ns_) > kPosePeriod_ns) return std::nullopt;
    return pose.sample.position.x;
  }

  test::FakeBus fake_;
  std::int64_t now_ns_ = kPosePeriod_ns;
  std::map<std::uint8_t, std::uint64_t> seq_{{kGuest[0], 1000}};  // each counts for himself
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<HeldTools> held_;
  std::unique_ptr<transport::LatestByTool<msg::ToolPose>> poses_;
};

TEST_F(HeldToolsTest, TheScenesDeviceIsSeenWhoeverElseMovesTheTool) {
  begin("omega");
  go(10, {kGuest});
  EXPECT_EQ(seen(), kGuest[0]) << "nobody else is there";
  introduce("omega", kWanted);
  go(110, {kWanted, kGuest});
  EXPECT_EQ(seen(), kWanted[0]) << "the last pose is the guest's, and it does not count";
  msg::ToolPose invalid = well();
  invalid.valid = false;
  go(10, {kGuest}, invalid);
  go(1, {kWanted});
  EXPECT_EQ(seen(), kWanted[0]);
  fake_.leave<msg::DeviceInfo>(kWanted);
  go(60, {kGuest});
  EXPECT_EQ(seen(), kGuest[0]);
}

TEST_F(HeldToolsTest, WhoSendsNoPosesTakesNoTool) {
  begin("omega");
  go(10, {kGuest});
  introduce("omega", kWanted);
  msg::ToolPose before_calibration = well();
  before_calibration.orientation = {0, 0, 0, 0};
  for (int i = 0; i < 100; ++i) {
    go(1, {kWanted}, before_calibration);
    go(1, {kGuest});
  }
  EXPECT_EQ(seen(), kGuest[0]);
}

TEST_F(HeldToolsTest, AHandThatCountsLowerIsSeenAsSoonAsItHasTheTool) {
  begin("omega");
  go(10, {kGuest});
  introduce("omega", kWanted);
  go(60, {kWanted});
  EXPECT_EQ(seen(), kWanted[0]);
}

TEST_F(HeldToolsTest, WhoDescribesTwoToolsIsWantedAtBothUntilHeCallsHimselfOtherwiseAtOne) {
  begin("omega");
  introduce("omega", kWanted);
  introduce("omega", kWanted, 0);
  go(10, {kGuest});
  EXPECT_FALSE(seen()) << "the wanted one is there, its hand rests";
  introduce("resting", kWanted);
  go(10, {kGuest});
  EXPECT_EQ(seen(), kGuest[0]);
}

TEST_F(HeldToolsTest, WhoeverIsAnsweredIsSeenAlsoByWhoCameLate) {
  begin("omega");
  introduce("omega", kWanted);
  go(100, {kGuest});
  EXPECT_FALSE(seen()) << "nobody is known to have come before the wanted one";
  answer(kGuest);
  go(1, {kGuest});
  EXPECT_EQ(seen(), kGuest[0]);
  for (int i = 0; i < 1500; ++i) {
    answer(kGuest);
    go(1, {kGuest});
  }
  EXPECT_EQ(seen(), kGuest[0]);
  go(1500, {kGuest});
  EXPECT_FALSE(seen()) << "haptic_node began anew, and found the wanted one there";
  go(1, {kWanted});
  EXPECT_EQ(seen(), kWanted[0]);
}

TEST_F(HeldToolsTest, OfTwoEqualOnesTheOneThatIsAnsweredIsSeenWhateverItCounts) {
  begin("omega");
  go(100, {kWanted, kGuest});
  ASSERT_EQ(seen(), kWanted[0]) << "it was heard first; its name nobody asks for";
  answer(kGuest);
  go(1, {kWanted, kGuest});
  EXPECT_EQ(seen(), kGuest[0]);
  go(100, {kWanted, kGuest});
  EXPECT_EQ(seen(), kGuest[0]);
  answer(kWanted);
  go(1, {kGuest, kWanted});
  EXPECT_EQ(seen(), kWanted[0]) << "which counts from far below";
}

TEST_F(HeldToolsTest, WhereTheSceneNamesNoDeviceEverythingCounts) {
  begin("");
  EXPECT_FALSE(held_->admits());
  go(10, {kWanted, kGuest});
  EXPECT_EQ(seen(), kGuest[0]) << "who counts higher";
  seq_[kWanted[0]] = 2000;
  go(1, {kGuest, kWanted});
  EXPECT_EQ(seen(), kWanted[0]);
}

}  // namespace
}  // namespace omentum::node
