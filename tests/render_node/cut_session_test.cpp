// What the drawing thread makes of states and topologies that come over the wire, in whatever order.
#include "render_node/plausible.h"
#include "render_node/session_watch.h"

#include "ball_organ.h"
#include "box_organ.h"
#include "recording_renderer.h"
#include "tests/support/fake_bus.h"
#include "tests/support/scripted_pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace omentum::render {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// Two boxes; the right one is cut by what the test posts.
class CutSessionTest : public testing::Test {
 protected:
  static constexpr std::size_t kRight = 1;
  CutSessionTest() { cutter_.cut(test::in_slit, true); }
  static scene::Scene scene_of_two() {
    scene::Scene scene = test::scene_with({"probe"});
    scene.organs.resize(2);
    return scene;
  }
  static LoadedOrgan loaded(const OrganShape& box, const char* name) {
    return {.name = name,
            .hash = "aaaa",
            .node_count = box.rest.size(),
            .reach_m = reach_of(box.rest),
            .tetrahedron_count = box.mesh->tetrahedra.size(),
            .most_nodes = box.mesh->positions.size()};
  }
  msg::Topology topology(std::uint64_t version, const RemovedSet& removed) const {
    msg::Topology message{};
    message.organ = kRight;
    message.version = version;
    message.tetrahedron_count = static_cast<std::uint32_t>(box_.mesh->tetrahedra.size());
    message.removed_bits = removed.bits;
    message.burnt_bits = removed.burnt;
    return message;
  }
  void post_state(std::uint64_t version, const std::vector<float>& values) {
    msg::OrganState state{};
    state.organ = kRight;
    state.block_count = 1;
    state.seq = ++seq_;
    state.stamp_ns = static_cast<std::int64_t>(seq_);
    state.topology_version = version;
    state.node_count = static_cast<std::uint32_t>(values.size() / 3);
    state.values = values;
    bus_.post(state);
  }
  std::int32_t drawn_removed() {
    watch_.listen(inbox_, view_, faults_, kSecond);
    EXPECT_EQ(view_.removed_count(0), 0) << "each organ has its own topology";
    return view_.removed_count(kRight);
  }
  bool has_fault(const std::string& text) {
    const auto lines = faults_.lines();
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line.starts_with(text); });
  }

  const OrganShape box_ = test::box_organ(3);
  test::Cutter cutter_{box_};
  const std::vector<float> whole_ = std::vector<float>(3 * box_.rest.size(), 0.0f);
  const std::vector<LoadedOrgan> organs_{loaded(box_, "left"), loaded(box_, "right")};
  const scene::Scene scene_ = scene_of_two();
  RecordingRenderer renderer_;
  SceneView view_{scene_, {box_, box_}, renderer_};
  runtime::FaultList faults_;
  omentum::test::FakeBus bus_;
  std::unique_ptr<transport::Bus> joined_ = bus_.opener()();
  omentum::test::ScriptedPace clock_{1000};
  Inbox inbox_{*joined_, scene_, organs_, clock_, faults_};
  SessionWatch watch_{scene_, organs_, 0};
  std::uint64_t seq_ = 0;
};

TEST_F(CutSessionTest, ATopologyIsDrawnWithItsState) {
  bus_.post(topology(1, cutter_.removed()));
  EXPECT_EQ(drawn_removed(), 0) << "where the new nodes are only a state says";
  post_state(1, cutter_.rest());
  EXPECT_EQ(drawn_removed(), cutter_.books().removed_count());
  EXPECT_FALSE(faults_.any());
}

TEST_F(CutSessionTest, AStateWaitsForItsTopology) {
  post_state(1, cutter_.rest());
  EXPECT_EQ(drawn_removed(), 0);
  bus_.post(topology(1, cutter_.removed()));
  EXPECT_EQ(drawn_removed(), cutter_.books().removed_count());
  EXPECT_EQ(inbox_.unmatched_states(), 0u);
  EXPECT_FALSE(faults_.any());
}

TEST_F(CutSessionTest, OfStatesThatWaitTheNewestIsDrawn) {
  const auto raised = [&](double height_m) {
    return cutter_.state([&](const Vec3&) { return Vec3(0, 0, height_m); });
  };
  post_state(1, raised(0.001));
  post_state(1, raised(0.002));
  bus_.post(topology(1, cutter_.removed()));
  EXPECT_GT(drawn_removed(), 0);
  EXPECT_NEAR(view_.surface(kRight)->skin.largest_displacement_m(), 0.002, 1e-6);
  EXPECT_EQ(inbox_.unmatched_states(), 1u);
}

TEST_F(CutSessionTest, StatesOfATopologyThatIsPastAreDropped) {
  bus_.post(topology(8, RemovedSet{}));
  bus_.post(topology(9, cutter_.removed()));
  post_state(9, cutter_.rest());
  EXPECT_GT(drawn_removed(), 0);
  post_state(7, whole_);
  EXPECT_GT(drawn_removed(), 0);
  EXPECT_EQ(inbox_.unmatched_states(), 1u);
  post_state(8, whole_);
  EXPECT_EQ(drawn_removed(), 0) << "but the one before the newest is known";
}

TEST_F(CutSessionTest, AResetIsAHigherVersionOfWhichNothingIsRemoved) {
  bus_.post(topology(1, cutter_.removed()));
  post_state(1, cutter_.rest());
  EXPECT_GT(drawn_removed(), 0);
  bus_.post(topology(2, RemovedSet{}));
  post_state(2, whole_);
  EXPECT_EQ(drawn_removed(), 0);
}

TEST_F(CutSessionTest, TheCutsOfARestartedServerAreDrawnWhateverItCounts) {
  bus_.post(topology(5, cutter_.removed()));
  post_state(5, cutter_.rest());
  bus_.post(topology(0, RemovedSet{}));
  post_state(0, whole_);
  EXPECT_EQ(drawn_removed(), 0);
  bus_.post(topology(1, cutter_.removed()));
  post_state(1, cutter_.rest());
  EXPECT_GT(drawn_removed(), 0);
}

TEST_F(CutSessionTest, ATopologyOfAnotherOrganIsAFaultAndChangesNothing) {
  msg::Topology larger = topology(1, cutter_.removed()), nowhere = larger;
  ++larger.tetrahedron_count;
  nowhere.organ = 7;
  bus_.post(larger);
  bus_.post(nowhere);
  EXPECT_TRUE(has_fault("topology of another organ than the scene's"));
  EXPECT_TRUE(has_fault("topology of an organ that the scene does not have"));
  post_state(1, cutter_.rest());
  EXPECT_EQ(drawn_removed(), 0);
}

TEST_F(CutSessionTest, AStateThatHasNotTheNodesOfItsTopologyIsAFaultAndNotDrawn) {
  bus_.post(topology(1, cutter_.removed()));
  post_state(1, whole_);
  EXPECT_EQ(drawn_removed(), 0);
  EXPECT_TRUE(has_fault(kMisfitState));
  EXPECT_EQ(renderer_.updates, 0);
}

TEST_F(CutSessionTest, ThePanelSaysWhatIsRemovedAndWhetherTimeKeepsUp) {
  bus_.post(topology(1, cutter_.removed()));
  post_state(1, cutter_.rest());
  msg::NodeStatus status{};
  status.kind = msg::NODE_DEFORM;
  status.real_time_factor = 0.75;
  bus_.post(status);
  PanelView panel;
  const std::int32_t removed = drawn_removed();
  watch_.describe(view_, clock_.now_ns(), panel);
  EXPECT_EQ(panel.organs[0].removed_tetrahedra, 0);
  EXPECT_EQ(panel.organs[1].removed_tetrahedra, removed);
  EXPECT_EQ(panel.real_time_factor, 0.75);
}

TEST(RealTimeFactor, IsThatOfTheServerThatSpeaks) {
  msg::NodeStatus serving{}, hand{};
  serving.kind = msg::NODE_DEFORM;
  hand.kind = msg::NODE_HAPTIC;
  serving.real_time_factor = 0.7;
  hand.real_time_factor = 5;
  EXPECT_EQ(real_time_factor({{serving, 0}, {hand, 0}}, 0), 0.7);
  EXPECT_EQ(real_time_factor({{serving, 0}}, 60 * kSecond), 0) << "silent";
  serving.real_time_factor = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(real_time_factor({{serving, 0}}, 0), 0);
}

}  // namespace
}  // namespace omentum::render
