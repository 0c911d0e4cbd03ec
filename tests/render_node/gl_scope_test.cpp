// What is seen through an endoscope: its light, its shadows, and a wire that glows.
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"

#include "ball_organ.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

using test::ball_organ;
using test::scene_with;

constexpr Size kScopePicture{160, 120};
constexpr double kBall_m = 0.02;

class ThroughTheScope : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = gl::open_offscreen(kScopePicture);
    } catch (const gl::DisplayError& error) {
      GTEST_SKIP() << error.what();
    }
    scene_ = scene_with({"probe", "endoscope"});
    scene_.tools[0].edge = {Vec3(0, 0, 0.004), Vec3(0, 0, -0.012)};
    scene_.tools[0].shaft_radius_m = 0.004;
    scene_.tools[1].scope.emplace().optics_deg = 0;
    choices_.endoscope = true;
    scope_.seen = true;
    scope_.p_WT = {0, -0.1, 0};
    // its shaft comes from -y: it looks along +y, upright along z
    scope_.q_WT = Eigen::AngleAxisd(0.5 * EIGEN_PI, Vec3::UnitX());
  }
  void show(std::vector<OrganShape> organs) {
    view_ = std::make_unique<SceneView>(scene_, organs, *renderer_);
    choices_.orbit = view_->first_camera();
  }
  Picture draw(const ToolNow& probe = {}) {
    renderer_->begin_frame();
    renderer_->draw(view_->frame(choices_, std::vector{probe, scope_}, 0));
    Picture picture = renderer_->read_back();
    renderer_->end_frame();
    return picture;
  }
  // Eight-bit values, as they are shown, around where a point of W is seen.
  static Vec3f colour_at(const Picture& picture, const View& view, const Vec3& p) {
    const Eigen::Vector4f clip = view.clip_from_eye * (view.eye_from_W * p.cast<float>().homogeneous());
    const int x = static_cast<int>(kScopePicture.width * (0.5f + 0.5f * clip.x() / clip.w()));
    const int y = static_cast<int>(kScopePicture.height * (0.5f - 0.5f * clip.y() / clip.w()));
    Vec3f sum = Vec3f::Zero();
    for (int row = y - 1; row <= y + 1; ++row) {
      for (int column = x - 1; column <= x + 1; ++column) {
        const std::uint8_t* pixel =
            &picture.rgba[4 * static_cast<std::size_t>(row * kScopePicture.width + column)];
        sum += Vec3f(pixel[0], pixel[1], pixel[2]) / 9;
      }
    }
    return sum;
  }
  View view() const { return view_->frame(choices_, std::vector{ToolNow{}, scope_}, 0).view; }

  scene::Scene scene_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<SceneView> view_;
  ViewChoices choices_;
  ToolNow scope_;
};

TEST_F(ThroughTheScope, WhatIsFartherIsDarker) {
  OrganShape near = ball_organ(kBall_m, 3), far = near;
  for (Vec3& p : near.rest) p += Vec3(-0.024, 0, 0);
  for (Vec3& p : far.rest) p += Vec3(0.05, 0.1, 0);
  show({near, far});
  // a place on each ball that faces the scope a little from above
  const Vec3 side = kBall_m * Vec3(0, -0.9, 0.43);
  const auto red = [&] {
    const Picture picture = draw();
    return std::pair{colour_at(picture, view(), Vec3(-0.024, 0, 0) + side).x(),
                     colour_at(picture, view(), Vec3(0.05, 0.1, 0) + side).x()};
  };
  const auto [near_red, far_red] = red();
  EXPECT_GT(near_red, 60);
  // more than twice as far away is a fifth of the light, of which the film makes two thirds of the value
  EXPECT_LT(far_red, 0.8f * near_red);
}

// What was drawn before, through no scope, must not stay beside the round field of view.
TEST_F(ThroughTheScope, BesideTheFieldOfViewAllIsBlackAtEveryQuality) {
  show({ball_organ(kBall_m, 3)});
  Frame scope = view_->frame(choices_, std::vector{ToolNow{}, scope_}, 0);
  choices_.endoscope = false;
  Frame orbit = view_->frame(choices_, std::vector{ToolNow{}, scope_}, 0);
  orbit.with_panel = scope.with_panel = false;
  for (std::size_t q = 0; q < kQualityCount; ++q) {
    orbit.quality = scope.quality = static_cast<Quality>(q);
    renderer_->draw(orbit);
    renderer_->draw(scope);
    const Picture picture = renderer_->read_back();
    int seen = 0;
    for (int x = 0; x < kScopePicture.width; ++x) {
      const std::uint8_t* pixel =
          &picture.rgba[4 * static_cast<std::size_t>(kScopePicture.height / 2 * kScopePicture.width + x)];
      const float off = std::abs(static_cast<float>(x) + 0.5f - kScopePicture.width / 2.0f);
      const int light = pixel[0] + pixel[1] + pixel[2];
      if (off > 0.5f * 1.075f * kScopePicture.height + 4) {
        EXPECT_EQ(light, 0) << "quality " << q << ", column " << x;
      } else if (light > 0) {
        ++seen;
      }
    }
    EXPECT_GT(seen, 0.9 * kScopePicture.height) << "quality " << q;
  }
}

TEST_F(ThroughTheScope, AnInstrumentShadesTheTissueBelowItWhichTheLampAboveTheLensLooksPast) {
  show({ball_organ(kBall_m, 4)});
  ToolNow probe;
  probe.seen = true;
  probe.p_WT = {-0.012, -0.045, 0.002};
  probe.q_WT = Eigen::AngleAxisd(0.5 * EIGEN_PI, Vec3::UnitY());  // its shaft goes to +x, across the picture
  const Picture without = draw(), with = draw(probe);
  int darker = 0, above = 0;
  for (int y = 0; y < kScopePicture.height; ++y) {
    for (int x = 0; x < kScopePicture.width; ++x) {
      const std::size_t i = 4 * static_cast<std::size_t>(y * kScopePicture.width + x);
      const bool tissue =
          with.rgba[i] > 1.5 * with.rgba[i + 1] && without.rgba[i] > 1.5 * without.rgba[i + 1];
      if (!tissue || with.rgba[i] > 0.8 * without.rgba[i]) continue;
      ++darker;
      above += y < kScopePicture.height / 2 - 6 ? 1 : 0;
    }
  }
  EXPECT_GT(darker, 15);
  EXPECT_LT(above, darker / 3) << "the light comes from above";
}

TEST_F(ThroughTheScope, TheWireOfAHookGlowsWhileItCuts) {
  show({ball_organ(kBall_m, 3)});
  ToolNow hook;
  hook.seen = true;
  hook.p_WT = {0, -0.06, 0.005};
  const Vec3 on_wire = hook.p_WT - Vec3(0, 0, 0.009);
  const Vec3f cold = colour_at(draw(hook), view(), on_wire);
  hook.cuts = true;
  const Vec3f hot = colour_at(draw(hook), view(), on_wire);
  EXPECT_GT(hot.x(), cold.x() + 20);
  EXPECT_GT(hot.x(), hot.z() + 20) << "orange, not white";
}

}  // namespace
}  // namespace omentum::render
