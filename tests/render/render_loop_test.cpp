// The node's loop on a renderer that only remembers, with a scripted person at its window.
#include "render_node/render_loop.h"

#include "node_common/node_identity.h"
#include "runtime/rate_loop.h"

#include "block_session.h"
#include "panel_context.h"
#include "recording_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <nlohmann/json.hpp>

#include <deque>
#include <mutex>

namespace omentum::render {
namespace {

using testing::ElementsAre;

constexpr double kPaceHz = 1000;  // as fast as it goes: nobody looks
constexpr Size kWindow{960, 600};

/// What a person does before a frame; true: done, the next step may follow.
using Step = std::function<bool(Input&)>;

/// Moves the mouse over the panel until Dear ImGui says that it is over the item called `label`, then clicks.
class Click {
 public:
  explicit Click(const char* label) : label_(label) {}
  bool operator()(Input&) {
    ImGuiIO& io = ImGui::GetIO();
    if (presses_ > 0 || hovered()) {
      io.MouseDown[0] = presses_ == 0;
      return ++presses_ > 2;
    }
    io.MousePos = {x_, y_};
    y_ += kStep;
    if (y_ > kWindow.height) x_ += 10 * kStep, y_ = kStep;
    if (x_ > kWindow.width) ADD_FAILURE() << "no item " << label_;
    return x_ > kWindow.width;
  }

 private:
  bool hovered() const {
    const ImGuiWindow* panel = ImGui::FindWindowByName("omentum");
    return panel != nullptr && ImGui::GetHoveredID() == ImHashStr(label_, 0, panel->ID);
  }
  static constexpr float kStep = 6;  // pixels, a third of a button's height
  const char* label_;
  float x_ = 30, y_ = kStep;
  int presses_ = 0;
};

class RenderLoopTest : public testing::Test {
 protected:
  void SetUp() override {
    renderer_.windowed = true;
    renderer_.on_begin_frame = [this] { return next_input(); };
    renderer_.on_panel = [] { ImGui::Render(); };
    options_.node.scene = block_.scene();
    options_.node.domain = test::domain_of_test();
    options_.fps = kPaceHz;
    bus_ = transport::Bus::open(
        {.vendor = transport::Vendor::kCyclone, .domain = options_.node.domain, .name = "test"});
  }

  void then(Step step) { script_.push_back(std::move(step)); }
  void drag(float x, float y) {
    then([=](Input& input) {
      input.orbit_x = x, input.orbit_y = y;
      return true;
    });
  }
  void remember_eye() {
    then([this](Input&) {
      eyes_.push_back(renderer_.frames.back().view.eye);
      return true;
    });
  }
  void idle() {
    then([](Input&) { return true; });
  }
  nlohmann::json run() {
    runtime::RateLoop pace(kPaceHz);
    RenderLoop loop(
        options_, [this] { return node::open_bus(options_.node, "render_node"); }, renderer_, pace);
    loop.run();
    return loop.report();
  }

  PanelContext context_;
  test::BlockScene block_;
  RenderOptions options_;
  RecordingRenderer renderer_{kWindow};
  std::unique_ptr<transport::Bus> bus_;
  std::vector<Vec3f> eyes_;

 private:
  // After the last step the person closes the window.
  Input next_input() {
    Input input;
    if (script_.empty()) {
      input.close = true;
    } else if (script_.front()(input)) {
      script_.pop_front();
    }
    ImGui::GetIO().DisplaySize = {static_cast<float>(kWindow.width), static_cast<float>(kWindow.height)};
    ImGui::NewFrame();
    return input;
  }
  std::deque<Step> script_;
};

TEST_F(RenderLoopTest, ClosingTheWindowEndsItAndIsReported) {
  EXPECT_EQ(run()["closed"], true);
}

TEST_F(RenderLoopTest, EndOfItsTimeIsNotAClosedWindow) {
  options_.seconds = 0.1;
  then([](Input&) { return false; });
  EXPECT_EQ(run()["closed"], false);
}

TEST_F(RenderLoopTest, DraggingTurnsTheOrbitButNotTheEndoscope) {
  idle();
  remember_eye();
  drag(50, 0);
  idle();
  remember_eye();
  then(Click("endoscope"));
  idle();
  drag(50, 0);
  idle();
  then(Click("endoscope"));
  idle();
  remember_eye();
  run();
  ASSERT_EQ(eyes_.size(), 3u);
  EXPECT_GT((eyes_[1] - eyes_[0]).norm(), 1e-3f);
  EXPECT_LT((eyes_[2] - eyes_[1]).norm(), 1e-6f) << "the hidden camera stayed";
}

TEST_F(RenderLoopTest, ButtonsSendTheirCommands) {
  std::mutex mutex;
  std::vector<std::uint32_t> heard;
  const auto commands = bus_->reader<msg::SessionCommand>([&](const msg::SessionCommand& command) {
    const std::lock_guard lock(mutex);
    heard.push_back(command.command);
  });
  const auto wait_for = [&](std::size_t count) {
    then([&, count](Input&) {
      const std::lock_guard lock(mutex);
      return heard.size() >= count;
    });
  };
  const auto begin = std::chrono::steady_clock::now();
  then([&](Input&) {  // a sample sent before the reader listens is lost
    using std::chrono::seconds;
    return commands->status().matched > 0 && std::chrono::steady_clock::now() - begin > seconds(1);
  });
  then(Click("Pause"));
  wait_for(1);
  then(Click("Start"));
  wait_for(2);
  then(Click("Reset"));
  wait_for(3);
  then(Click("Clear fault"));
  wait_for(4);
  run();
  EXPECT_THAT(heard, ElementsAre(msg::COMMAND_PAUSE, msg::COMMAND_START, msg::COMMAND_RESET,
                                 msg::COMMAND_CLEAR_FAULT));
}

TEST_F(RenderLoopTest, DeepestDentIsTakenFromNearbyWithoutThePanel) {
  const test::ScratchFolder folder;
  options_.out = folder.path();
  const auto states = bus_->writer<msg::OrganState>();
  test::PressingTool tool(*bus_, block_.organ());
  std::uint64_t seq = 0;
  then([&](Input&) {
    states->write(test::state_of(block_.organ(), ++seq, {0, 0, -0.01}));
    tool.speak();
    return !renderer_.read_back_from.empty();
  });
  const auto report = run();
  ASSERT_FALSE(renderer_.read_back_from.empty());
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
  test::PressingTool tool(*bus_, block_.organ());
  int spoken = 0;
  then([&](Input&) {  // a tool that presses an organ of which nothing is known
    tool.speak();
    return ++spoken > 300;
  });
  EXPECT_EQ(run()["deepest_dent_m"], 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "indent.png"));
}

TEST_F(RenderLoopTest, LogHoldsThePeriodsOfTheFramesThatWereDrawn) {
  const test::ScratchFolder folder;
  options_.node.log = folder / "frames.csv";
  options_.fps = 50;  // the pace ticks twenty times as often: most of its ticks draw nothing
  for (int k = 0; k < 5; ++k) idle();
  const auto report = run();
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
  for (std::size_t k = 1; k < starts.size(); ++k) EXPECT_EQ(periods[k], starts[k] - starts[k - 1]);
}

}  // namespace
}  // namespace omentum::render
