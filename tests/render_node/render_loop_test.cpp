// The node's loop between a scripted bus and a scripted pace, on a renderer that only remembers, with a
// scripted person at its window.
#include "render_node/render_loop.h"
#include "render_node/panel_keys.h"
#include "render_node/video_slots.h"

#include "block_session.h"
#include "panel_context.h"
#include "recording_renderer.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <nlohmann/json.hpp>

namespace omentum::render {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr double kPace_hz = 1000;
constexpr Size kWindow{960, 600};
constexpr int kStatusFrames = 100;  // ten statuses in a second

class RenderLoopTest : public testing::Test {
 protected:
  using Node = omentum::test::StagedLoop<RenderLoop>;

  void SetUp() override {
    renderer_.windowed = true;
    renderer_.on_begin_frame = [this] { return next_input(); };
    renderer_.on_panel = [] { ImGui::Render(); };
    options_.node.scene = block().scene();
    options_.fps = 2 * kPace_hz;  // each tick of the pace is a frame
  }

  static const test::BlockScene& block() {
    static const test::BlockScene scene(3);
    return scene;
  }
  static const organ::Organ& organ() {
    static const organ::Organ organ = block().organ();
    return organ;
  }
  void start() { node_ = std::make_unique<Node>(kPace_hz, options_, bus_.opener(), renderer_); }
  void frames(int count) { node_->tick(count); }
  void frame(const Input& input) {
    input_ = input;
    node_->tick();
  }
  nlohmann::json close() {
    frame({.close = true});
    EXPECT_EQ(node_->end(), "");
    return node_->loop().report();
  }
  Vec3f eye() {
    frames(1);
    return renderer_.frames.back().view.eye;
  }
  void drag() { frame({.orbit_x = 50}); }
  /// Moves the mouse over the panel's bar until Dear ImGui says that it is over the button of `control`, then
  /// clicks.
  void click(Control control) {
    constexpr float kStep = 12;  // pixels, two thirds of a button's height
    frames(1);
    const ImGuiWindow* bar = ImGui::FindWindowByName("controls");
    ASSERT_NE(bar, nullptr);
    const ImRect all = bar->Rect();
    for (float y = all.Min.y + kStep; y < all.Max.y; y += kStep) {
      for (float x = all.Min.x + kStep; x < all.Max.x; x += 2 * kStep) {
        mouse_ = {x, y};
        frames(1);
        if (!hovers(control)) continue;
        frames(1);  // where nothing is hovered Dear ImGui names what was
        if (hovers(control)) return press_and_release();
      }
    }
    ADD_FAILURE() << "no button " << word_of(control).button_id;
  }
  void type(char letter) { frame({.keys = KeyPresses(letter)}); }
  std::vector<std::string> faults() {
    frames(kStatusFrames);
    return bus_.newest<msg::NodeStatus>()->faults;
  }

  PanelContext context_;
  RenderOptions options_;
  RecordingRenderer renderer_{kWindow};
  omentum::test::FakeBus bus_;
  std::unique_ptr<Node> node_;

 private:
  static bool hovers(Control control) {
    const ImGuiWindow* bar = ImGui::FindWindowByName("controls");
    return ImGui::GetHoveredID() == ImHashStr(word_of(control).button_id, 0, bar->ID);
  }
  void press_and_release() {
    for (const bool down : {true, false, false}) {
      mouse_down_ = down;
      frames(1);
    }
  }
  Input next_input() {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(kWindow.width), static_cast<float>(kWindow.height)};
    io.MousePos = mouse_;
    io.MouseDown[0] = mouse_down_;
    ImGui::NewFrame();
    return std::exchange(input_, Input{});
  }

  Input input_;
  ImVec2 mouse_{0, 0};
  bool mouse_down_ = false;
};

TEST_F(RenderLoopTest, ClosingTheWindowEndsItAndIsReported) {
  start();
  frame({.close = true});
  EXPECT_FALSE(node_->tick());
  EXPECT_EQ(node_->loop().report()["closed"], true);
}

TEST_F(RenderLoopTest, EndOfItsTimeIsNotAClosedWindow) {
  options_.seconds = 0.1;
  start();
  EXPECT_TRUE(node_->tick(99));
  EXPECT_FALSE(node_->tick());
  EXPECT_EQ(node_->loop().report()["closed"], false);
}

TEST_F(RenderLoopTest, DraggingTurnsTheOrbitButNotTheEndoscope) {
  start();
  const Vec3f before = eye();
  drag();
  const Vec3f turned = eye();
  click(Control::kCamera);
  drag();
  click(Control::kCamera);
  EXPECT_GT((turned - before).norm(), 1e-3f);
  EXPECT_LT((eye() - turned).norm(), 1e-6f) << "the hidden camera stayed";
}

constexpr std::array kSent{std::pair(Control::kFlow, msg::COMMAND_PAUSE),
                           std::pair(Control::kFlow, msg::COMMAND_START),
                           std::pair(Control::kReset, msg::COMMAND_RESET),
                           std::pair(Control::kClearFault, msg::COMMAND_CLEAR_FAULT)};

TEST_F(RenderLoopTest, ButtonsSendTheirCommands) {
  bus_.watch<msg::SessionCommand>();
  start();
  for (const auto& [control, sent] : kSent) {
    bus_.expect<msg::SessionCommand>(Field(&msg::SessionCommand::command, sent));
    click(control);
    EXPECT_THAT(bus_.left_over(), IsEmpty()) << word_of(control).does;
  }
}

TEST_F(RenderLoopTest, KeysSendTheirCommandsWithoutAPanelToo) {
  options_.no_panel = true;
  bus_.watch<msg::SessionCommand>();
  start();
  for (const auto& [control, sent] : kSent) {
    bus_.expect<msg::SessionCommand>(Field(&msg::SessionCommand::command, sent));
    type(word_of(control).key);
    EXPECT_THAT(bus_.left_over(), IsEmpty()) << word_of(control).does;
  }
}

TEST_F(RenderLoopTest, AKeySwitchesTheLinesOfTrianglesOnAndOff) {
  start();
  for (const bool on : {true, false}) {
    type('L');
    frames(1);
    EXPECT_EQ(renderer_.frames.back().wires, on);
  }
}

TEST_F(RenderLoopTest, WhatARecordingSessionShowsIsAVideoThatLastsAsLong) {
  const test::ScratchFolder folder;
  options_.out = folder.path();
  options_.record_fps = 50;
  start();
  frames(10);
  type('V');
  frames(500);
  click(Control::kRecord);
  const auto videos = close()["videos"];
  ASSERT_THAT(videos, SizeIs(1));
  EXPECT_NEAR(videos[0]["seconds"].get<double>(), 0.5, 0.2) << "and what the mouse took to find the button";
  const auto pictures = videos[0]["pictures"].get<int>();
  EXPECT_TRUE(std::filesystem::exists(folder / "video" / video_picture_name(pictures - 1)));
  EXPECT_FALSE(std::filesystem::exists(folder / "video" / video_picture_name(pictures)));
}

TEST_F(RenderLoopTest, RecordsFromTheStartAndOnWhenAPersonOfTheSessionAsks) {
  const test::ScratchFolder folder;
  options_.out = folder.path();
  options_.record = true;
  start();
  frames(200);
  const auto order = [&](std::uint64_t number, const char* argument) {
    bus_.post(msg::SessionCommand{
        .order = number, .sender = 1, .command = msg::COMMAND_RECORD, .argument = argument});
    frames(200);
  };
  order(1, node::kRecordOn);
  order(2, "");
  order(3, node::kRecordOff);
  order(4, "");
  const auto videos = close()["videos"];
  ASSERT_THAT(videos, SizeIs(2));
  EXPECT_NEAR(videos[0]["seconds"].get<double>(), 0.4, 0.1);
  EXPECT_EQ(videos[1]["folder"], (folder / "video_2").string());
}

TEST_F(RenderLoopTest, ACommandThatCannotBeSentIsAFault) {
  start();
  bus_.refuse_writes<msg::SessionCommand>(true);
  click(Control::kFlow);
  EXPECT_THAT(faults(), ElementsAre(StartsWith("a command could not be sent")));
}

TEST_F(RenderLoopTest, DrawsAStateAndTellsThePoseThatItShows) {
  start();
  frames(1);
  const int updates = renderer_.updates;
  const msg::OrganState state = test::state_of(organ(), 7, {0, 0, -0.01});
  bus_.post(state);
  frames(1);
  EXPECT_GT(renderer_.updates, updates);
  frames(kStatusFrames);
  const auto status = bus_.newest<msg::NodeStatus>();
  EXPECT_EQ(status->kind, msg::NODE_RENDER);
  EXPECT_THAT(status->echoes, ElementsAre(state.echoes[0]));
}

TEST_F(RenderLoopTest, AStateThatDoesNotFitIsAFaultAndNotDrawn) {
  start();
  frames(1);
  const int updates = renderer_.updates;
  msg::OrganState state = test::state_of(organ(), 1, {0, 0, -0.01});
  state.values[0] = 1e30f;
  bus_.post(state);
  EXPECT_THAT(faults(), ElementsAre(StartsWith("organ state of another kind or size")));
  EXPECT_EQ(renderer_.updates, updates);
}

TEST_F(RenderLoopTest, DrawsACutOfTheOrganThatItLoaded) {
  start();
  frames(1);
  const geometry::TetId removed = organ().surface.tetrahedron.front();
  geometry::MeshEditor books(organ().mesh, {.uncut_surface = organ().surface.node});
  books.remove(std::array{removed});
  msg::Topology topology{};
  topology.version = 1;
  topology.tetrahedron_count = static_cast<std::uint32_t>(organ().mesh.tetrahedra.size());
  topology.removed_bits.assign(books.removed_bits().begin(), books.removed_bits().end());
  bus_.post(topology);
  msg::OrganState state = test::state_of(organ(), 1, {0, 0, 0});
  state.topology_version = 1;
  state.node_count = static_cast<std::uint32_t>(books.surface_nodes().size());
  state.values.assign(3 * books.surface_nodes().size(), 0);
  bus_.post(state);
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_THAT(renderer_.frames.back().items, Contains(Field(&DrawItem::look, Look::kBared)));
  const nlohmann::json report = close();
  EXPECT_EQ(report["unmatched_states"], 0);
  EXPECT_EQ(report["organ_states"]["whole"], 1);
}

/// A session in which deform_node tells what tissue is under.
class MapTest : public RenderLoopTest {
 protected:
  /// deform_node's next state, and its values where somebody reads them.
  void tell() {
    ++seq_;
    bus_.post(test::state_of(organ(), seq_, {0, 0, 0}));
    if (is_read()) bus_.post(values(seq_));
    frames(1);
  }
  msg::OrganStress values(std::uint64_t seq) const {
    msg::OrganStress values{};
    values.block_count = 1;
    values.seq = seq;
    values.node_count = static_cast<std::uint32_t>(organ().surface.node_count());
    values.strains.assign(values.node_count, 0.15f);
    values.stresses.assign(values.node_count, stress_pa_);
    return values;
  }
  bool is_read() { return deform_writer_->status().matched > 0; }
  const std::vector<DrawItem>& items() const { return renderer_.frames.back().items; }
  /// The share of the organ's first vertex.
  float share() const {
    const auto organ = std::ranges::find(items(), Look::kMap, &DrawItem::look);
    return organ == items().end() ? -1 : renderer_.mesh_of(*organ).vertices[0].share;
  }

  float stress_pa_ = 0;
  const testing::Matcher<const std::vector<DrawItem>&> map_ = Contains(Field(&DrawItem::look, Look::kMap));

 private:
  std::uint64_t seq_ = 0;
  std::unique_ptr<transport::Bus> deform_ = bus_.opener()();
  std::unique_ptr<transport::Writer<msg::OrganStress>> deform_writer_ = deform_->writer<msg::OrganStress>();
};

TEST_F(MapTest, AKeyAndAButtonSwitchThroughStrainAndStressAndOff) {
  stress_pa_ = static_cast<float>(0.25 * full_stress_pa(organ().material.common.young_pa));
  start();
  tell();
  EXPECT_THAT(items(), testing::Not(map_));
  EXPECT_FALSE(is_read()) << "nobody asked";
  type('S');
  EXPECT_TRUE(is_read());
  tell();
  EXPECT_FLOAT_EQ(share(), 0.15f / kFullStrain);
  click(Control::kMap);
  EXPECT_THAT(items(), testing::Not(map_)) << "strain is not stress";
  tell();
  EXPECT_FLOAT_EQ(share(), 0.25f);
  type('S');
  EXPECT_FALSE(is_read());
  tell();
  EXPECT_THAT(items(), testing::Not(map_));
}

TEST_F(MapTest, WhoIsStartedWithAMapShowsItFromTheFirstValuesOn) {
  options_.map = TissueMap::kStrain;
  start();
  tell();
  EXPECT_THAT(items(), map_);
}

TEST_F(MapTest, AStateWaitsForItsValues) {
  options_.map = TissueMap::kStrain;
  start();
  tell();
  const int updates = renderer_.updates;
  bus_.post(test::state_of(organ(), 100, {0, 0, 0.01}));
  frames(1);
  EXPECT_EQ(renderer_.updates, updates);
  bus_.post(values(100));
  frames(1);
  EXPECT_GT(renderer_.updates, updates);
}

TEST_F(MapTest, ValuesOfAnotherOrganAreFaults) {
  options_.map = TissueMap::kStrain;
  start();
  msg::OrganStress foreign = values(1);
  foreign.organ = 7;
  bus_.post(foreign);
  foreign.organ = 0;
  foreign.node_count = 1'000'000;
  bus_.post(foreign);
  EXPECT_THAT(faults(), SizeIs(2));
}

TEST_F(RenderLoopTest, ReportsHowFarTheScenesOrganIsExposed) {
  options_.node.scene = block().scene_with("[[tools]]", "[score]\nexposed_organ = \"block\"\n[[tools]]");
  start();
  frames(1);
  EXPECT_EQ(close()["exposed_share"], (nlohmann::json{{"first", 1.0}, {"newest", 1.0}, {"largest", 1.0}}));
}

TEST_F(RenderLoopTest, BeforeTheScenesTimeNoExposureCounts) {
  options_.node.scene =
      block().scene_with("[[tools]]", "[score]\nexposed_organ = \"block\"\nfrom_s = 1000\n[[tools]]");
  start();
  frames(1);
  EXPECT_EQ(close()["exposed_share"]["first"], nullptr);
}

TEST_F(RenderLoopTest, WithoutAScoreNothingIsSaidOfExposure) {
  start();
  frames(1);
  EXPECT_FALSE(close().contains("exposed_share"));
}

TEST_F(RenderLoopTest, ReportsHowFinelyAndHowOftenItDrew) {
  start();
  frames(500);
  const auto picture = close()["picture"];
  EXPECT_EQ(picture["level"], words(PictureLevel{kFinestStep})) << "frames cost nothing here";
  EXPECT_NEAR(picture["reached_fps"], kPace_hz, 5);
  double all = 0;
  for (const auto& [quality, share] : picture["share"].items()) all += share.get<double>();
  EXPECT_NEAR(all, 1, 1e-9);
  EXPECT_GT(picture["share"]["fine"], 0.5);
}

TEST_F(RenderLoopTest, StatusesComeTenTimesASecondAndSayWhetherTheSessionIsPaused) {
  start();
  frames(1000);
  EXPECT_THAT(bus_.take_all<msg::NodeStatus>(), SizeIs(10));
  bus_.post(msg::SessionCommand{.order = 1, .sender = 1, .command = msg::COMMAND_PAUSE, .argument = {}});
  frames(kStatusFrames);
  EXPECT_TRUE(bus_.newest<msg::NodeStatus>()->paused);
  msg::NodeStatus haptic{};
  haptic.kind = msg::NODE_HAPTIC;
  haptic.instance = 1;
  bus_.post(haptic);
  frames(kStatusFrames);
  EXPECT_FALSE(bus_.newest<msg::NodeStatus>()->paused) << "who makes the forces knows";
}

TEST_F(RenderLoopTest, RefusesToShowAnotherOrganThanTheOneServed) {
  bus_.post(block().info("0123abcd"));
  start();
  EXPECT_FALSE(node_->tick());
  EXPECT_THAT(node_->end(), AllOf(HasSubstr("0123abcd"), HasSubstr(block().organ_hash())));
}

TEST_F(RenderLoopTest, ALateStrangersSceneIsAFaultAndNoEnd) {
  start();
  frames(5500);
  bus_.post(block().info("0123abcd"));
  EXPECT_THAT(faults(), ElementsAre(StartsWith(node::kForeignScene)));
  close();
}

TEST_F(RenderLoopTest, DeepestDentIsTakenFromNearbyWithoutThePanel) {
  const test::ScratchFolder folder;
  options_.out = folder.path();
  start();
  const auto others = bus_.opener()();
  test::PressingTool tool(*others, organ());
  for (std::uint64_t seq = 1; seq < 50; ++seq) {
    bus_.post(test::state_of(organ(), seq, {0, 0, -0.01}));
    tool.speak();
    frames(1);
  }
  ASSERT_THAT(renderer_.read_back_from, SizeIs(1));
  const auto report = close();
  const Frame& close_up = renderer_.frames.at(renderer_.read_back_from.front());
  const Frame& final = renderer_.frames.at(renderer_.read_back_from.back());
  EXPECT_FALSE(close_up.with_panel);
  EXPECT_TRUE(final.with_panel);
  EXPECT_TRUE(std::filesystem::exists(folder / "indent.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "final.png"));
  EXPECT_NEAR(report["deepest_dent_m"], 0.01, 1e-6);
}

TEST_F(RenderLoopTest, OrganOfALostDeformNodeHasNoDent) {
  const test::ScratchFolder folder;
  options_.out = folder.path();
  start();
  const auto others = bus_.opener()();
  test::PressingTool tool(*others, organ());
  for (int k = 0; k < 300; ++k) {  // a tool that presses an organ of which nothing is known
    tool.speak();
    frames(1);
  }
  EXPECT_EQ(close()["deepest_dent_m"], 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "indent.png"));
}

TEST_F(RenderLoopTest, LogHoldsThePeriodsOfTheFramesThatWereDrawn) {
  const test::ScratchFolder folder;
  options_.node.log = folder / "frames.csv";
  options_.fps = 50;  // the pace ticks twenty times as often: most of its ticks draw nothing
  start();
  frames(110);
  const auto report = close();
  node_->loop().require_written();
  std::istringstream lines(test::read_text(folder / "frames.csv"));
  std::string line;
  std::getline(lines, line);  // header
  std::vector<std::int64_t> starts, periods;
  while (std::getline(lines, line)) {
    long long index = 0, start = 0, period = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lld,%lld,%lld", &index, &start, &period), 3) << line;
    starts.push_back(start);
    periods.push_back(period);
  }
  ASSERT_EQ(starts.size(), report["frames"].get<std::size_t>());
  ASSERT_GE(starts.size(), 5u);
  for (std::size_t k = 1; k < starts.size(); ++k) EXPECT_EQ(periods[k], starts[k] - starts[k - 1]);
}

}  // namespace
}  // namespace omentum::render
