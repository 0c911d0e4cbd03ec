// Properties of the pixels that OpenGL draws, off-screen.
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/gl/window_keys.h"
#include "render_node/panel.h"
#include "render_node/scene_view.h"

#include "ball_organ.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace omentum::render {
namespace {

using test::ball_organ;
using test::dent;
using test::scene_with;
using test::tool_at;

constexpr double kRadius = 0.05;
constexpr Size kGlPicture{320, 240};
const Vec3 kFront = kRadius * Vec3(0, -0.8, 0.6);

using Rgb = Eigen::Array3i;

Rgb pixel(const Picture& picture, int x, int y) {
  const std::uint8_t* p = &picture.rgba[4 * static_cast<std::size_t>(y * picture.size.width + x)];
  return {p[0], p[1], p[2]};
}

// Pixels for which `is` holds, and their middle.
struct Area {
  int count = 0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
};
template <class Is>
Area area_where(const Picture& picture, Is&& is) {
  Area area;
  for (int y = 0; y < picture.size.height; ++y) {
    for (int x = 0; x < picture.size.width; ++x) {
      if (!is(x, y)) continue;
      ++area.count;
      area.middle += Eigen::Vector2d(x, y);
    }
  }
  if (area.count > 0) area.middle /= area.count;
  return area;
}
bool is_tissue(const Rgb& c) {
  return c[0] > 60 && c[0] > 2 * c[1] && c[0] > 2 * c[2];
}
bool is_blue_signal(const Rgb& c) {
  return c[2] > 150 && c[2] > 3 * c[0];
}
int difference(const Picture& a, const Picture& b, int x, int y) {
  return (pixel(a, x, y) - pixel(b, x, y)).abs().maxCoeff();
}

class Drawing : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = gl::open_offscreen(kGlPicture, 1);
    } catch (const gl::DisplayError& error) {
      GTEST_SKIP() << error.what();
    }
    arrange(*renderer_);
  }
  void arrange(Renderer& renderer) {
    scene_ = scene_with({"probe", "grasper"});
    scene_.camera.eye = {0, -0.22, 0.12};
    scene_.camera.target = {0, 0, 1e-6};
    view_ = std::make_unique<SceneView>(scene_, std::vector{shape_}, renderer);
    choices_.orbit = view_->first_camera();
  }
  Picture draw(Renderer& renderer, const std::vector<ToolNow>& tools, Quality quality = Quality::kFine) {
    renderer.begin_frame();
    Frame frame = view_->frame(choices_, tools, 0);
    frame.quality = quality;
    renderer.draw(frame);
    Picture picture = renderer.read_back();
    renderer.end_frame();
    return picture;
  }
  Picture draw(const std::vector<ToolNow>& tools = {{}, {}}) { return draw(*renderer_, tools); }

  // Where a point of W lies in the picture.
  Eigen::Vector2d at(const Vec3& p) const {
    const View view = view_of(choices_.orbit, view_->ball(), kGlPicture.aspect(), 0);
    const Eigen::Vector4f clip = view.clip_from_eye * (view.eye_from_W * p.cast<float>().homogeneous());
    return {kGlPicture.width * (0.5 + 0.5 * clip.x() / clip.w()),
            kGlPicture.height * (0.5 - 0.5 * clip.y() / clip.w())};
  }

  OrganShape shape_ = ball_organ(kRadius, 4);
  scene::Scene scene_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<SceneView> view_;
  ViewChoices choices_;
};

TEST_F(Drawing, LiverIsInTheMiddleAndTheCornersAreDark) {
  const Picture picture = draw();
  const Area tissue = area_where(picture, [&](int x, int y) { return is_tissue(pixel(picture, x, y)); });
  EXPECT_GT(tissue.count, kGlPicture.width * kGlPicture.height / 20);
  EXPECT_LT((tissue.middle - at(Vec3::Zero())).norm(), 15);
  for (const auto& [x, y] : {std::pair{1, 1}, {kGlPicture.width - 2, 1}})
    EXPECT_LT(pixel(picture, x, y).maxCoeff(), 60);
}

TEST_F(Drawing, DentIsSeenAroundTheToolInItsCloseUp) {
  constexpr double kDepth_m = 0.006;  // what the default scene's hand presses
  constexpr int kSeen = 20;           // of 255: a step that nobody overlooks
  ToolNow tool = tool_at(kFront * (1 - kDepth_m / kRadius), Vec3::Zero());
  std::size_t pressed = 0;  // the node next to the front
  for (std::size_t s = 0; s < shape_.rest.size(); ++s)
    if ((shape_.rest[s] - kFront).norm() < (shape_.rest[pressed] - kFront).norm()) pressed = s;
  tool.contact_nodes = {static_cast<std::uint32_t>(pressed) + test::kFirstFileNode};
  tool.contact_forces_n = {1};
  view_->deform(0, dent(shape_, kFront, kDepth_m, 0.009));
  const Frame frame = view_->close_up(*view_->dent_of(tool), choices_, std::vector<ToolNow>{tool, {}});
  const auto shot = [&] {
    renderer_->begin_frame();
    renderer_->draw(frame);
    Picture picture = renderer_->read_back();
    renderer_->draw(
        view_->frame(choices_, std::vector<ToolNow>{tool, {}}, 0));  // the ordinary one, with the panel
    renderer_->end_frame();
    return picture;
  };
  const Picture pressed_picture = shot();
  view_->deform(0, std::vector<float>(3 * shape_.rest.size(), 0.0f));
  const Picture rest_picture = shot();
  const Area changed = area_where(
      rest_picture, [&](int x, int y) { return difference(pressed_picture, rest_picture, x, y) > kSeen; });
  // at least the dent itself: 18 mm across, seen 23 degrees above its rim, in a picture of 78 mm by 59 mm
  EXPECT_GT(changed.count, 0.02 * kGlPicture.width * kGlPicture.height);
  EXPECT_LT((changed.middle - 0.5 * Eigen::Vector2d(kGlPicture.width, kGlPicture.height)).norm(),
            0.25 * kGlPicture.width);
}

TEST_F(Drawing, NoPixelIsBroken) {
  // a division by zero or a root of a negative number shows as black or white speckles inside the organ
  const Picture picture = draw();
  const Eigen::Vector2d middle = at(Vec3::Zero());
  const Area black = area_where(picture, [&](int x, int y) {
    return (Eigen::Vector2d(x, y) - middle).norm() < 40 && pixel(picture, x, y).maxCoeff() < 8;
  });
  EXPECT_EQ(black.count, 0);
}

TEST_F(Drawing, SamePictureTwice) {
  const Picture once = draw(), twice = draw();
  int largest = 0;
  for (std::size_t i = 0; i < once.rgba.size(); ++i)
    largest = std::max(largest, std::abs(once.rgba[i] - twice.rgba[i]));
  EXPECT_LE(largest, 1) << "one step of rounding: the driver may compile a shader anew";
}

TEST_F(Drawing, DentChangesPixelsNearTheToolAndNotFarAway) {
  const Picture before = draw();
  const Vec3 where = shape_.rest[0 + 3];  // the node at -y, facing the camera
  view_->deform(0, dent(shape_, where, 0.008, 0.006));
  const Picture after = draw();
  const Eigen::Vector2d middle = at(where);
  const auto changed = [&](double from, double to) {
    return area_where(before,
                      [&](int x, int y) {
                        const double r = (Eigen::Vector2d(x, y) - middle).norm();
                        return r >= from && r < to && difference(before, after, x, y) > 12;
                      })
        .count;
  };
  EXPECT_GT(changed(0, 25), 200);
  const Area far = area_where(before, [&](int x, int y) {
    return (Eigen::Vector2d(x, y) - middle).norm() > 100 && difference(before, after, x, y) > 12;
  });
  EXPECT_EQ(far.count, 0);
}

TEST_F(Drawing, InstrumentsAreVisible) {
  const Picture without = draw();
  const Picture with = draw({tool_at(kFront, Vec3::Zero()), {}});
  const Vec3 on_shaft = kFront + 0.03 * kFront.normalized();
  const Eigen::Vector2d p = at(on_shaft);
  EXPECT_GT(difference(without, with, static_cast<int>(p.x()), static_cast<int>(p.y())), 20);
}

TEST_F(Drawing, InstrumentCastsAShadowOnTheOrgan) {
  // the lamp stands to the camera's left: a shaft above the organ darkens tissue that it does not hide
  ToolNow tool = tool_at(kFront + 0.004 * kFront.normalized(), Vec3::Zero());
  const Picture without = draw();
  const Picture with = draw({tool, {}});
  const Area darker = area_where(without, [&](int x, int y) {
    const Rgb a = pixel(without, x, y), b = pixel(with, x, y);
    return is_tissue(a) && is_tissue(b) && b[0] < 0.7 * a[0];
  });
  EXPECT_GT(darker.count, 30);
}

TEST_F(Drawing, ArrowPointsInTheForcesDirection) {
  for (const Vec3& force : {Vec3(2, 0, 0), Vec3(-2, 0, 0), Vec3(0, 0, 2), Vec3(1, 0, 1)}) {
    const Picture picture = draw({tool_at(kFront, force), {}});
    const Picture without = draw({tool_at(kFront, Vec3::Zero()), {}});
    const Area arrow = area_where(picture, [&](int x, int y) {
      return is_blue_signal(pixel(picture, x, y)) && difference(picture, without, x, y) > 20;
    });
    ASSERT_GT(arrow.count, 40);
    const Eigen::Vector2d seen = (arrow.middle - at(kFront)).normalized();
    const Eigen::Vector2d expected = (at(kFront + 0.01 * force.normalized()) - at(kFront)).normalized();
    EXPECT_GT(seen.dot(expected), 0.95) << force.transpose();
  }
}

TEST_F(Drawing, QualitiesShowTheSame) {
  const std::vector<ToolNow> tools{tool_at(kFront, Vec3(1, 0, 1)), {}};
  const Picture fine = draw(*renderer_, tools);
  for (const Quality quality : {Quality::kPlain, Quality::kCoarse}) {
    const Picture other = draw(*renderer_, tools, quality);
    double sum = 0;
    for (std::size_t i = 0; i < fine.rgba.size(); ++i) sum += std::abs(fine.rgba[i] - other.rgba[i]);
    EXPECT_LT(sum / static_cast<double>(fine.rgba.size()), 5) << "mean difference of eight-bit values";
  }
}

TEST_F(Drawing, TheCoarsestPictureShowsTheSameOrgan) {
  const auto tissue = [&](Quality quality) {
    const Picture picture = draw(*renderer_, {{}, {}}, quality);
    return area_where(picture, [&](int x, int y) { return is_tissue(pixel(picture, x, y)); });
  };
  const Area round = tissue(Quality::kDraft), corners = tissue(Quality::kFaint);
  ASSERT_GT(round.count, 1000);
  EXPECT_NEAR(corners.count, round.count, 0.04 * round.count);
  EXPECT_LT((corners.middle - round.middle).norm(), 2) << "pixels";
}

TEST_F(Drawing, LinesOfTheTrianglesLieOnTheOrganAndLeaveItSeen) {
  const Picture plain = draw();
  choices_.wires = true;
  const Picture lined = draw();
  const auto lighter = [&](int x, int y) {
    return (pixel(lined, x, y) - pixel(plain, x, y)).minCoeff() > 20;
  };
  const Area tissue = area_where(plain, [&](int x, int y) { return is_tissue(pixel(plain, x, y)); });
  const Area lines =
      area_where(plain, [&](int x, int y) { return is_tissue(pixel(plain, x, y)) && lighter(x, y); });
  EXPECT_GT(lines.count, tissue.count / 20);
  EXPECT_LT(lines.count, tissue.count * 9 / 10);
  const Area outside = area_where(plain, [&](int x, int y) {
    const bool far = (Eigen::Vector2d(x, y) - at(Vec3::Zero())).norm() > 110;
    return far && difference(plain, lined, x, y) > 2;
  });
  EXPECT_EQ(outside.count, 0);
}

TEST(WindowKeys, AreTheLettersOfThePersonsLayout) {
  constexpr int kA = 65, kM = 77, kF1 = 290, kControl = 2;  // GLFW's
  EXPECT_EQ(gl::letter_of(kA, 0, "q"), 'q') << "a French keyboard";
  EXPECT_EQ(gl::letter_of(kM, 0, ","), 0) << "and its comma";
  EXPECT_EQ(gl::letter_of(kA, 0, "\xd1\x84"), 'A') << "a Russian one";
  EXPECT_EQ(gl::letter_of(kA, 0, nullptr), 'A');
  EXPECT_EQ(gl::letter_of(kF1, 0, nullptr), 'H');
  EXPECT_EQ(gl::letter_of(kA, kControl, "a"), 0);
  EXPECT_EQ(gl::letter_of(32, 0, nullptr), 0);
}

TEST_F(Drawing, EndoscopeIsRound) {
  choices_.endoscope = true;
  const Picture picture = draw();
  const int y = kGlPicture.height / 2;
  EXPECT_EQ(pixel(picture, 2, y).maxCoeff(), 0) << "black outside";
  EXPECT_GT(pixel(picture, kGlPicture.width / 2, y).maxCoeff(), 20);
}

TEST_F(Drawing, PanelIsDrawnOverThePicture) {
  const Picture without = draw();
  renderer_->begin_frame();
  PanelView panel;
  panel.scene = "a ball";
  lay_out_panel(panel);
  renderer_->draw(view_->frame(choices_, std::vector<ToolNow>(2), 0));
  renderer_->end_frame();
  renderer_->begin_frame();
  lay_out_panel(panel);
  renderer_->draw(view_->frame(choices_, std::vector<ToolNow>(2), 0));
  const Picture with = renderer_->read_back();
  renderer_->end_frame();
  const Area bright = area_where(with, [&](int x, int y) {
    return x < 200 && y < 40 && pixel(with, x, y).minCoeff() > 150;  // text
  });
  EXPECT_GT(bright.count, 20);
  EXPECT_EQ(difference(with, without, kGlPicture.width - 5, kGlPicture.height - 5), 0);
}

TEST_F(Drawing, WindowAndOffscreenAgree) {
  if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no display for a window";
  const std::vector<ToolNow> tools{tool_at(kFront, Vec3(1, 0, 1)), {}};
  const Picture offscreen = draw(*renderer_, tools);
  renderer_.reset();  // one panel at a time
  try {
    renderer_ = gl::open_window(kGlPicture, "test", 1);
  } catch (const gl::DisplayError& error) {
    GTEST_SKIP() << error.what();
  }
  if (renderer_->size() != kGlPicture) GTEST_SKIP() << "the window has another size than asked for";
  arrange(*renderer_);
  const Picture window = draw(*renderer_, tools);
  int different = 0;
  for (std::size_t i = 0; i < window.rgba.size(); ++i)
    different += std::abs(window.rgba[i] - offscreen.rgba[i]) > 2;
  EXPECT_LT(different, static_cast<int>(window.rgba.size() / 1000));
}

}  // namespace
}  // namespace omentum::render
