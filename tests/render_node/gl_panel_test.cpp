// The panel's picture over the scene's, off-screen.
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr Size kUnderPanel{480, 360};

class PanelPictureTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = gl::open_offscreen(kUnderPanel, 1);
    } catch (const gl::DisplayError& error) {
      GTEST_SKIP() << error.what();
    }
  }
  // The backdrop, and over it a panel that says `scene`.
  Picture draw(const std::string& scene) {
    renderer_->begin_frame();
    PanelView panel;
    panel.scene = scene;
    lay_out_panel(panel);
    renderer_->draw(Frame{});
    Picture picture = renderer_->read_back();
    renderer_->end_frame();
    return picture;
  }
  Picture draw_without() {
    renderer_->begin_frame();
    Frame frame;
    frame.with_panel = false;
    renderer_->draw(frame);
    Picture picture = renderer_->read_back();
    renderer_->end_frame();
    return picture;
  }
  static int red(const Picture& picture, int x, int y) {
    return picture.rgba[4 * static_cast<std::size_t>(y * kUnderPanel.width + x)];
  }

  std::unique_ptr<Renderer> renderer_;
};

TEST_F(PanelPictureTest, AFrameWithoutThePanelLeavesTheNextOneWhole) {
  draw_without();
  const Picture after = draw("liver");
  EXPECT_EQ(after.rgba, draw("liver").rgba);
}

TEST_F(PanelPictureTest, APictureInMemoryAlwaysHasThePanelOfItsFrame) {
  draw("liver");
  const Picture liver = draw("liver"), gut = draw("gut");
  EXPECT_NE(liver.rgba, gut.rgba);
  EXPECT_EQ(liver.rgba, draw("liver").rgba);
}

TEST_F(PanelPictureTest, ItsBackgroundIsMixedOnceAndNothingBesideItChanges) {
  const Picture without = draw_without();
  draw("liver");
  const Picture with = draw("liver");
  const ImVec4 background = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  const int free_of_text = static_cast<int>(kPanelMargin) + 3;
  for (int x = 30; x < static_cast<int>(kPanelWidth) - 20; ++x) {
    const float under = static_cast<float>(red(without, x, free_of_text));
    const float mixed = under + background.w * (255 * background.x - under);
    EXPECT_NEAR(red(with, x, free_of_text), mixed, 1.5) << x;
  }
  for (int y = 0; y < kUnderPanel.height; ++y)
    for (int x = static_cast<int>(kPanelMargin + kPanelWidth) + 2; x < kUnderPanel.width; ++x)
      ASSERT_EQ(red(with, x, y), red(without, x, y)) << x << " " << y;
}

}  // namespace
}  // namespace omentum::render
