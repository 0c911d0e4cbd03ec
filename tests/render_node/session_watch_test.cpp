// What the drawing thread makes of what comes over the wire, its clock injected.
#include "render_node/session_watch.h"
#include "render_node/plausible.h"

#include "ball_organ.h"
#include "recording_renderer.h"
#include "tests/support/fake_bus.h"
#include "tests/support/scripted_pace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace omentum::render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kWatchedSecond = 1'000'000'000;
constexpr double kRadius_m = 0.05;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// A session of two balls and one probe; everything else is what the test posts.
class SessionWatchTest : public testing::Test {
 protected:
  static scene::Scene scene_of_two() {
    scene::Scene scene = test::scene_with({"probe"});
    scene.organs.resize(2);
    return scene;
  }
  void listen(std::int64_t now_ns) { watch_.listen(inbox_, view_, faults_, now_ns); }
  bool has_fault(const std::string& text) {
    const auto lines = faults_.lines();
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line.starts_with(text); });
  }

  const OrganShape ball_ = test::ball_organ(kRadius_m, 2);
  const std::vector<LoadedOrgan> organs_{{"left", "aaaa", ball_.rest.size(), reach_of(ball_.rest)},
                                         {"right", "bbbb", ball_.rest.size(), reach_of(ball_.rest)}};
  const scene::Scene scene_ = scene_of_two();
  RecordingRenderer renderer_;
  SceneView view_{scene_, {ball_, ball_}, renderer_};
  runtime::FaultList faults_;
  omentum::test::FakeBus bus_;
  std::unique_ptr<transport::Bus> joined_ = bus_.opener()();
  omentum::test::ScriptedPace clock_{1000};
  Inbox inbox_{*joined_, scene_, organs_, clock_, faults_};
  SessionWatch watch_{scene_, organs_, 0};
};

TEST(TrustedOf, AHybridThatTurnsWithItsTissueIsNotTrustedByItsDisplacements) {
  scene::OrganSpec organ{.name = "liver", .model = "hybrid", .dynamics = scene::DynamicsSpec{}};
  organ.dynamics->law = "linear";
  EXPECT_EQ(trusted_of(organ), scene::Trusted::kSmallDisplacements);
  organ.dynamics->law = "corotational";
  EXPECT_EQ(trusted_of(organ), scene::Trusted::kSmallStrains);
}

TEST_F(SessionWatchTest, AForeignSceneEndsANodeThatStartsAndIsAFaultOfASettledOne) {
  const msg::SceneInfo foreign{.protocol = msg::PROTOCOL_VERSION + 1, .scene = "s", .organs = {}};
  bus_.post(foreign);
  listen(60 * kWatchedSecond);
  EXPECT_TRUE(has_fault("scene: a deform_node with other organs"));
  bus_.post(foreign);
  std::string why;
  try {
    listen(kWatchedSecond);
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  EXPECT_THAT(why, HasSubstr("protocol"));
}

TEST_F(SessionWatchTest, OfSeveralOrgansThePanelSaysWhichOneItMeans) {
  PanelView panel;
  watch_.describe(view_, 60 * kWatchedSecond, panel);
  ASSERT_EQ(panel.organs.size(), 2u);
  EXPECT_TRUE(panel.organs[0].stale());
  EXPECT_EQ(panel.organs[0].name, "left");
  EXPECT_EQ(panel.organs[1].name, "right");
}

TEST_F(SessionWatchTest, APeakBetweenTwoFramesCountsAndOneBeyondTheScenesLimitDoesNot) {
  listen(kWatchedSecond);
  msg::ToolForce force{};
  const auto feel = [&](double force_n) {
    ++force.seq;
    force.force = {0, 0, force_n};
    bus_.post(force);
  };
  const double limit_n = scene_.haptics.max_force_n;
  for (const double force_n : {0.1 * limit_n, 0.9 * limit_n, 100 * limit_n, kNan, 0.2 * limit_n})
    feel(force_n);
  listen(kWatchedSecond + 1);
  PanelView panel;
  watch_.describe(view_, kWatchedSecond + 1, panel);
  EXPECT_FLOAT_EQ(panel.tools[0].force_n, static_cast<float>(0.2 * limit_n));
  EXPECT_FLOAT_EQ(panel.tools[0].most_n, static_cast<float>(0.9 * limit_n));
}

TEST_F(SessionWatchTest, ThePanelKnowsHowLargeAnOrganIs) {
  PanelView panel;
  watch_.describe(view_, kWatchedSecond, panel);
  EXPECT_EQ(panel.organs[0].nodes, ball_.rest.size());
}

TEST_F(SessionWatchTest, AToolIsDrawnWithTheOrganThatItPresses) {
  msg::ToolPose pose{};
  pose.seq = 1;
  pose.valid = true;
  pose.orientation.w = 1;
  msg::ToolForce force{};
  force.seq = 1;
  msg::Contact left{}, pressed{}, nowhere{};
  pressed.organ = 1;
  pressed.nodes = {5};
  pressed.forces = {{0, 0, -1}};
  pressed.displacements = {{0, 0, 0}};
  nowhere.organ = 7;
  bus_.post(pose);
  bus_.post(force);
  for (const msg::Contact& contact : {pressed, left, nowhere}) bus_.post(contact);
  EXPECT_TRUE(has_fault("contact with an organ that the scene does not have"));
  listen(kWatchedSecond);
  EXPECT_EQ(watch_.tools()[0].contact_organ, 1u);
  EXPECT_THAT(watch_.tools()[0].contact_nodes, ElementsAre(5u));
}

TEST_F(SessionWatchTest, AStateOfAnotherKindIsAFault) {
  msg::OrganState state{};
  state.block_count = 1;
  state.kind = msg::KIND_TUBE;
  state.node_count = static_cast<std::uint32_t>(ball_.rest.size());
  state.values.assign(3 * ball_.rest.size(), 0);
  bus_.post(state);
  EXPECT_TRUE(has_fault("organ state of another kind"));
}

// Both of a pause's copies around a start that another person gave.
TEST_F(SessionWatchTest, ObeysCommandsByTheRuleOfAllNodes) {
  const auto send = [&](std::uint32_t what, std::uint64_t order) {
    bus_.post(msg::SessionCommand{.order = order, .sender = 1, .command = what, .argument = {}});
  };
  send(msg::COMMAND_PAUSE, 0);
  listen(kWatchedSecond);
  EXPECT_TRUE(watch_.paused(kWatchedSecond)) << "a sender may count from zero";
  send(msg::COMMAND_START, 1);
  send(msg::COMMAND_PAUSE, 0);
  send(msg::COMMAND_RESET, 2);
  EXPECT_TRUE(inbox_.orders().take_reset());
  listen(kWatchedSecond);
  EXPECT_FALSE(watch_.paused(kWatchedSecond));
}

TEST_F(SessionWatchTest, OnlyWhatCanBeDrawnIsDrawn) {
  msg::ToolPose pose{};
  pose.valid = true;
  pose.orientation.w = 1;
  msg::ToolForce force{};
  force.force = {0, 0, 1};
  const auto show = [&](msg::ToolPose p, msg::ToolForce f) {
    p.seq = f.seq = ++pose.seq;
    bus_.post(p);
    bus_.post(f);
    listen(clock_.now_ns());
  };
  show(pose, force);
  EXPECT_TRUE(watch_.tools()[0].seen);
  EXPECT_EQ(watch_.tools()[0].force_n, Vec3(0, 0, 1));
  for (const double absurd : {kNan, kInf, 1e30, 1e4}) {
    msg::ToolPose far = pose;
    far.position.y = absurd;
    msg::ToolForce strong = force;
    strong.force.x = absurd;
    show(far, strong);
    EXPECT_FALSE(watch_.tools()[0].seen) << absurd;
    EXPECT_EQ(watch_.tools()[0].force_n, Vec3(0, 0, 0)) << absurd;
  }
}

TEST_F(SessionWatchTest, ToolsAndForcesOfWhoFellSilentAreGone) {
  msg::ToolPose pose{};
  pose.valid = true;
  pose.orientation.w = 1;
  msg::ToolForce force{};
  force.force = {0, 0, 1};
  bus_.post(pose);
  bus_.post(force);
  clock_.stall(kWatchedSecond / 2);
  listen(clock_.now_ns());
  EXPECT_TRUE(watch_.tools()[0].seen);
  EXPECT_EQ(watch_.tools()[0].force_n, Vec3(0, 0, 0));
  clock_.stall(kWatchedSecond);
  listen(clock_.now_ns());
  EXPECT_FALSE(watch_.tools()[0].seen);
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
