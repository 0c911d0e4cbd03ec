// A mouse device beside the node's loop, on a scripted bus.
#include "render_node/render_loop.h"

#include "block_session.h"
#include "panel_context.h"
#include "recording_renderer.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr double kLinkPace_hz = 1000;
constexpr Size kLinkWindow{960, 600};

class PointerLinkTest : public testing::Test {
 protected:
  void SetUp() override {
    renderer_.windowed = true;
    renderer_.on_begin_frame = [this] {
      ImGui::GetIO().DisplaySize = {static_cast<float>(kLinkWindow.width),
                                    static_cast<float>(kLinkWindow.height)};
      ImGui::NewFrame();
      return input_;
    };
    renderer_.on_panel = [] { ImGui::Render(); };
    options_.node.scene = block_.scene();
  }
  void start(double fps) {
    options_.fps = fps;
    node_ = std::make_unique<omentum::test::StagedLoop<RenderLoop>>(kLinkPace_hz, options_, bus_.opener(),
                                                                    renderer_);
  }
  std::size_t signals() const {
    const auto& items = renderer_.frames.back().items;
    return static_cast<std::size_t>(std::ranges::count(items, Look::kSignal, &DrawItem::look));
  }

  PanelContext context_;
  test::BlockScene block_{3};
  RenderOptions options_;
  RecordingRenderer renderer_{kLinkWindow};
  omentum::test::FakeBus bus_;
  std::unique_ptr<omentum::test::StagedLoop<RenderLoop>> node_;
  Input input_;
};

TEST_F(PointerLinkTest, BetweenFramesThePointerIsStillSeen) {
  const auto peer = bus_.opener()();
  test::PressingTool tool(*peer, block_.organ());
  std::vector<msg::PointerRay> rays;
  const auto reader = peer->reader<msg::PointerRay>([&](const msg::PointerRay& ray) { rays.push_back(ray); });
  int looks = 0;
  renderer_.on_look = [&] {
    ++looks;
    return Pointer{.inside = true, .x = 0.7f, .y = 0.5f, .dx = 2, .wheel = 1, .camera_key = looks > 40};
  };
  start(kLinkPace_hz / 10);  // nine ticks in ten draw nothing
  tool.speak();
  node_->tick(30);
  EXPECT_GT(looks, 15);
  ASSERT_GT(rays.size(), 20U);
  EXPECT_EQ(rays.back().wheel, looks);
  // what the camera missed comes with its next frame
  node_->tick(40);
  const Vec3f eye = renderer_.frames.back().view.eye;
  input_.pointer = {.inside = true, .buttons = msg::POINTER_LEFT, .camera_key = true};
  node_->tick(20);
  EXPECT_GT((renderer_.frames.back().view.eye - eye).norm(), 1e-4f);
}

TEST_F(PointerLinkTest, RaysGoOutWhileADeviceListensAndShowWhatItFeels) {
  const auto peer = bus_.opener()();
  test::PressingTool tool(*peer, block_.organ());
  input_.pointer = {.inside = true, .x = 0.7f, .y = 0.5f};
  input_.orbit_x = 20;
  start(2 * kLinkPace_hz);  // each tick of the pace is a frame
  tool.speak();
  node_->tick(2);
  const std::size_t before = signals();
  const Vec3f eye = renderer_.frames.back().view.eye;

  std::vector<msg::PointerRay> rays;
  const auto reader = peer->reader<msg::PointerRay>([&](const msg::PointerRay& ray) { rays.push_back(ray); });
  node_->tick(300);  // it is looked for now and then
  tool.speak();
  rays.clear();
  node_->tick(2);
  ASSERT_EQ(rays.size(), 2U);
  EXPECT_TRUE(rays[1].valid);
  EXPECT_EQ(rays[1].tool, 0U);
  EXPECT_EQ(rays[1].seq, rays[0].seq + 1);
  EXPECT_EQ(signals(), before + 3) << "ring, bar and its track";
  const Vec3f now = renderer_.frames.back().view.eye;
  EXPECT_NE(now, eye) << "it turned until the device came";
  node_->tick(2);
  EXPECT_EQ(renderer_.frames.back().view.eye, now) << "the camera's input is not the tool's";
}

}  // namespace
}  // namespace omentum::render
