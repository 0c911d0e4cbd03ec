// The loops of all three nodes on one bus: what a session is, without its processes and its wire.
#include "deform_node/deform_loop.h"
#include "haptic_node/haptic_loop.h"
#include "render_node/render_loop.h"

#include "tests/haptic_node/haptic_block.h"
#include "tests/render_node/recording_renderer.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace omentum {
namespace {

using haptic_test::kAbove;
using haptic_test::kPressed;
using haptic_test::Vec3;
using haptic_test::vector;
using testing::IsEmpty;

constexpr double kHandRate_hz = 1000, kOrganRate_hz = 100, kFrameRate_hz = 50;
constexpr int kOrganEvery = 10, kFrameEvery = 20;  // ticks of the hand

class SessionLoopsTest : public testing::Test {
 protected:
  SessionLoopsTest() {
    haptic_ = start<haptic::HapticLoop>(haptic::HapticOptions{.node = options(), .rate_hz = kHandRate_hz},
                                        kHandRate_hz);
    deform_ = start_deform();
    render_ = std::make_unique<test::StagedLoop<render::RenderLoop>>(
        kFrameRate_hz,
        render::RenderOptions{
            .node = options(), .size = {}, .fps = 2 * kFrameRate_hz, .out = {}, .no_panel = true},
        bus_.opener(), renderer_);
  }

  runtime::NodeOptions options() const {
    runtime::NodeOptions node;
    node.scene = block_.scene();
    return node;
  }
  template <class Loop, class Options>
  std::unique_ptr<test::StagedLoop<Loop>> start(const Options& options, double rate_hz) {
    return std::make_unique<test::StagedLoop<Loop>>(rate_hz, options, bus_.opener());
  }
  std::unique_ptr<test::StagedLoop<deform::DeformLoop>> start_deform() {
    return start<deform::DeformLoop>(
        deform::DeformOptions{.node = options(), .journal = {}, .rate_hz = kOrganRate_hz}, kOrganRate_hz);
  }

  /// A millisecond, in which the hand is at `tip`.
  void live(const Vec3& tip) {
    msg::ToolPose pose{};
    pose.seq = ++now_;
    pose.stamp_ns = haptic_->pace().now_ns();
    pose.valid = true;
    pose.position = {.x = tip.x(), .y = tip.y(), .z = tip.z()};
    pose.orientation.w = 1;
    bus_.post(pose);
    haptic_->tick();
    if (deform_ && now_ % kOrganEvery == 0) deform_->tick();
    if (now_ % kFrameEvery == 0) render_->tick();
  }
  void hold(const Vec3& tip, int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) live(tip);
  }
  /// All listened, forces faded in, then 9 mm down and there for half a second.
  void press() {
    constexpr int kWay = 45;
    hold(kAbove, 1500);
    for (int i = 1; i <= kWay; ++i) live(kAbove + (kPressed - kAbove) * i / kWay);
    hold(kPressed, 500);
  }
  double felt_n() { return vector(bus_.newest<msg::ToolForce>()->force).norm(); }
  std::optional<msg::NodeStatus> status_of(std::uint32_t kind) {
    std::optional<msg::NodeStatus> found;
    for (const msg::NodeStatus& status : bus_.take_all<msg::NodeStatus>())
      if (status.kind == kind) found = status;
    return found;
  }

  const test::BlockScene block_ = haptic_test::block_scene();
  render::RecordingRenderer renderer_;
  test::FakeBus bus_;
  std::uint64_t now_ = 0;  // ms since the session's start, and the pose's number
  std::unique_ptr<test::StagedLoop<haptic::HapticLoop>> haptic_;
  std::unique_ptr<test::StagedLoop<deform::DeformLoop>> deform_;
  std::unique_ptr<test::StagedLoop<render::RenderLoop>> render_;
};

TEST_F(SessionLoopsTest, APressIsFeltMovesTheOrganAndIsSeen) {
  press();
  EXPECT_GT(felt_n(), 0.1);
  const auto shown = status_of(msg::NODE_RENDER);
  ASSERT_TRUE(shown && !shown->echoes.empty());
  EXPECT_EQ(shown->echoes[0].tool, 0u);
  EXPECT_GT(shown->echoes[0].seq, now_ - 150) << "what was drawn is a pose of this moment";
  const auto state = bus_.newest<msg::OrganState>();
  double dent_m = 0;
  for (const float u : state->values) dent_m = std::max(dent_m, std::abs(double{u}));
  EXPECT_NEAR(dent_m, 0.1 - kPressed.z(), 0.001);

  EXPECT_EQ(haptic_->end() + deform_->end() + render_->end(), "");
  const double deepest_m = render_->loop().report()["deepest_dent_m"];
  EXPECT_GT(deepest_m, 0.3 * dent_m) << "less than the nodes' way: the surroundings go along";
  EXPECT_LE(deepest_m, dent_m);
  for (const auto& report : {haptic_->loop().report(), deform_->loop().report(), render_->loop().report()})
    EXPECT_THAT(report["faults"], IsEmpty()) << report["faults"];
}

TEST_F(SessionLoopsTest, WithoutDeformNodeTheForceStaysAndANewOneResumes) {
  press();
  const double felt = felt_n();
  deform_.reset();
  hold(kPressed, 2000);
  EXPECT_NEAR(felt_n(), felt, 1e-3 * felt);
  deform_ = start_deform();
  bus_.take_all<msg::OrganState>();
  hold(kPressed, 1500);
  const auto state = bus_.newest<msg::OrganState>();
  ASSERT_FALSE(state->echoes.empty());
  EXPECT_GT(state->echoes[0].seq, now_ - 50);
  EXPECT_NEAR(felt_n(), felt, 1e-3 * felt);
}

TEST_F(SessionLoopsTest, OneCommandPausesAll) {
  press();
  bus_.post(msg::SessionCommand{.order = 1, .sender = 1, .command = msg::COMMAND_PAUSE, .argument = {}});
  bus_.take_all<msg::NodeStatus>();
  hold(kPressed, 300);
  std::array<bool, 3> paused{};
  for (const msg::NodeStatus& status : bus_.take_all<msg::NodeStatus>())
    paused.at(status.kind) = status.paused;
  EXPECT_TRUE(paused[msg::NODE_HAPTIC] && paused[msg::NODE_DEFORM] && paused[msg::NODE_RENDER]);
  EXPECT_EQ(felt_n(), 0);
}

}  // namespace
}  // namespace omentum
