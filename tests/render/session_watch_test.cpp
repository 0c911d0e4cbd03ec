// What the drawing thread makes of what comes over the wire, its clock injected.
#include "render_node/session_watch.h"
#include "render_node/plausible.h"

#include "ball_organ.h"
#include "recording_renderer.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace omentum::render {
namespace {

using omentum::test::comes_true;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr double kRadiusM = 0.05;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// A session of two balls and one probe; everything else is the test's own writers.
class SessionWatchTest : public testing::Test {
 protected:
  void listen(std::int64_t now_ns) { watch_.listen(inbox_, view_, faults_, now_ns); }
  bool has_fault(const std::string& text) {
    const auto lines = faults_.lines();
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line.starts_with(text); });
  }

  const OrganShape ball_ = test::ball_organ(kRadiusM, 2);
  const std::vector<LoadedOrgan> organs_{{"left", "aaaa", ball_.rest.size(), reach_of(ball_.rest)},
                                         {"right", "bbbb", ball_.rest.size(), reach_of(ball_.rest)}};
  const runtime::Scene scene_ = test::scene_with({"probe"});
  RecordingRenderer renderer_;
  SceneView view_{scene_, {ball_, ball_}, renderer_};
  runtime::FaultList faults_;
  std::unique_ptr<transport::Bus> bus_ = transport::Bus::open(
      {.vendor = transport::Vendor::kCyclone, .domain = omentum::test::domain_of_test(), .name = "test"});
  runtime::SteadyClock clock_;
  Inbox inbox_{*bus_, organs_, clock_, faults_};
  SessionWatch watch_{scene_, organs_, 0};
};

TEST_F(SessionWatchTest, AForeignSceneEndsANodeThatStartsAndIsAFaultOfASettledOne) {
  const auto scenes = bus_->writer<msg::SceneInfo>();
  msg::SceneInfo foreign{.protocol = msg::PROTOCOL_VERSION + 1, .scene = "s", .organs = {}};
  EXPECT_TRUE(comes_true([&] {
    scenes->write(foreign);
    listen(60 * kSecond);
    return has_fault("scene: a deform_node with other organs");
  }));
  std::string why;
  EXPECT_TRUE(comes_true([&] {
    scenes->write(foreign);
    try {
      listen(kSecond);
    } catch (const std::runtime_error& error) {
      why = error.what();
    }
    return !why.empty();
  }));
  EXPECT_THAT(why, HasSubstr("protocol"));
}

TEST_F(SessionWatchTest, OfSeveralOrgansThePanelSaysWhichOneItMeans) {
  PanelView panel;
  watch_.describe(view_, 60 * kSecond, panel);
  ASSERT_EQ(panel.organs.size(), 2u);
  EXPECT_TRUE(panel.organs[0].stale());
  EXPECT_EQ(panel.organs[0].name, "left");
  EXPECT_EQ(panel.organs[1].name, "right");
}

TEST_F(SessionWatchTest, EachOrganHasItsOwnTopology) {
  const auto topologies = bus_->writer<msg::Topology>();
  msg::Topology cut{}, whole{}, nowhere{};
  cut.version = 1;
  whole.organ = 1;
  nowhere.organ = 7;
  // what came before the last one is in its box: one writer's samples come in order
  EXPECT_TRUE(comes_true([&] {
    for (const msg::Topology& topology : {cut, whole, nowhere}) topologies->write(topology);
    return has_fault("topology of an organ that the scene does not have");
  }));
  listen(kSecond);
  EXPECT_TRUE(has_fault("an organ was cut"));
}

// Both of a pause's copies around a start that another person gave.
TEST_F(SessionWatchTest, ObeysCommandsByTheRuleOfAllNodes) {
  const auto commands = bus_->writer<msg::SessionCommand>();
  const auto send = [&](std::uint32_t what, std::uint64_t seq) {
    commands->write({.seq = seq, .command = what, .argument = {}});
  };
  EXPECT_TRUE(comes_true([&] {
    send(msg::COMMAND_PAUSE, 0);
    listen(kSecond);
    return watch_.paused(kSecond);
  })) << "a sender may count from zero";
  send(msg::COMMAND_START, 1);
  send(msg::COMMAND_PAUSE, 0);
  send(msg::COMMAND_RESET, 2);  // the last of them
  EXPECT_TRUE(comes_true([&] { return inbox_.orders().take_reset(); }));
  listen(kSecond);
  EXPECT_FALSE(watch_.paused(kSecond));
}

TEST_F(SessionWatchTest, OnlyWhatCanBeDrawnIsDrawn) {
  const auto poses = bus_->writer<msg::ToolPose>();
  const auto forces = bus_->writer<msg::ToolForce>();
  msg::ToolPose pose{};
  pose.valid = true;
  pose.orientation.w = 1;
  msg::ToolForce force{};
  force.force = {0, 0, 1};
  const auto seen = [&](const msg::ToolPose& p, const msg::ToolForce& f) {
    const std::uint64_t seq = ++pose.seq;
    return comes_true([&, p = p, f = f]() mutable {
      p.seq = f.seq = seq;
      poses->write(p);
      forces->write(f);
      listen(transport::arrival_clock_ns());
      transport::Arrived<msg::ToolPose> came;
      transport::Arrived<msg::ToolForce> felt;
      return inbox_.pose(0, came) && came.sample.seq == seq && inbox_.force(0, felt) &&
             felt.sample.seq == seq;
    });
  };
  ASSERT_TRUE(seen(pose, force));
  listen(transport::arrival_clock_ns());
  EXPECT_TRUE(watch_.tools()[0].seen);
  EXPECT_EQ(watch_.tools()[0].force_n, Vec3(0, 0, 1));
  for (const double absurd : {kNan, kInf, 1e30, 1e4}) {
    msg::ToolPose far = pose;
    far.position.y = absurd;
    msg::ToolForce strong = force;
    strong.force.x = absurd;
    ASSERT_TRUE(seen(far, strong));
    listen(transport::arrival_clock_ns());
    EXPECT_FALSE(watch_.tools()[0].seen) << absurd;
    EXPECT_EQ(watch_.tools()[0].force_n, Vec3(0, 0, 0)) << absurd;
  }
}

TEST(Plausible, APoseIsAPlaceAndARotation) {
  msg::ToolPose pose{};
  pose.orientation.w = 1;
  EXPECT_TRUE(is_plausible(pose));
  msg::ToolPose none = pose;
  none.orientation.w = 0;
  EXPECT_FALSE(is_plausible(none)) << "a camera without a direction";
  none.orientation.w = kNan;
  EXPECT_FALSE(is_plausible(none));
  none = pose;
  none.grip = 1e300;
  EXPECT_FALSE(is_plausible(none));
}

TEST(Plausible, ForcesThatCancelAreForcesAllTheSame) {
  msg::Contact contact{};
  contact.forces = {{0, 0, 5}, {0, 0, -8}};
  EXPECT_TRUE(is_plausible(contact, 10));
  contact.forces = {{0, 0, 1e30}, {0, 0, -1e30}};
  EXPECT_FALSE(is_plausible(contact, 10));
  contact.forces = {{kNan, 0, 0}};
  EXPECT_FALSE(is_plausible(contact, 10));
}

}  // namespace
}  // namespace omentum::render
