// Properties of the pixels of an organ that was cut, off-screen.
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"

#include "box_organ.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

using test::Cutter;
using test::in_slit;
using test::kBoxSide_m;

constexpr Size kSize{320, 240};

/// A box seen from above its front, where the slit runs away from the camera.
class CutDrawing : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = gl::open_offscreen(kSize);
    } catch (const gl::DisplayError& error) {
      GTEST_SKIP() << error.what();
    }
    scene_.tools.emplace_back();
    scene_.camera.eye = {0.05, -0.10, 0.30};
    scene_.camera.target = {0.05, 0.05, 0.08};
    view_ = std::make_unique<SceneView>(scene_, std::vector{shape_}, *renderer_);
    choices_.orbit = view_->first_camera();
  }
  Picture draw() {
    renderer_->begin_frame();
    renderer_->draw(view_->frame(choices_, std::vector<ToolNow>(1), 0));
    Picture picture = renderer_->read_back();
    renderer_->end_frame();
    return picture;
  }
  Picture draw(const Cutter& cutter) {
    EXPECT_TRUE(view_->show(0, cutter.removed(), cutter.rest()));
    return draw();
  }
  Eigen::Array2i at(const Vec3& p) const {
    const View view = view_of(choices_.orbit, view_->ball(), kSize.aspect(), 0);
    const Eigen::Vector4f clip = view.clip_from_eye * (view.eye_from_W * p.cast<float>().homogeneous());
    return {static_cast<int>(kSize.width * (0.5 + 0.5 * clip.x() / clip.w())),
            static_cast<int>(kSize.height * (0.5 - 0.5 * clip.y() / clip.w()))};
  }
  // The mean colour of a small square of pixels around a point of W.
  Eigen::Array3d colour(const Picture& picture, const Vec3& p) const {
    constexpr int kReach = 5;
    const Eigen::Array2i middle = at(p);
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int y = middle.y() - kReach; y <= middle.y() + kReach; ++y) {
      for (int x = middle.x() - kReach; x <= middle.x() + kReach; ++x) {
        const std::uint8_t* pixel = &picture.rgba[4 * static_cast<std::size_t>(y * kSize.width + x)];
        sum += Eigen::Array3d(pixel[0], pixel[1], pixel[2]);
      }
    }
    return sum / ((2 * kReach + 1) * (2 * kReach + 1));
  }

  const OrganShape shape_ = test::box_organ(6);
  scene::Scene scene_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<SceneView> view_;
  ViewChoices choices_;
  const Vec3 in_cut_{0.5 * kBoxSide_m, 0.5 * kBoxSide_m, 0.5 * kBoxSide_m};
  const Vec3 beside_{0.15 * kBoxSide_m, 0.5 * kBoxSide_m, kBoxSide_m};
};

TEST_F(CutDrawing, TheSlitIsDarkerRawTissueAndTheRestStays) {
  const Picture whole = draw();
  Cutter cutter(shape_);
  cutter.cut(in_slit);
  const Picture cut = draw(cutter);
  const Eigen::Array3d before = colour(whole, in_cut_), raw = colour(cut, in_cut_);
  EXPECT_LT(raw[0], 0.8 * before[0]);
  EXPECT_GT(raw[0], 2 * raw[1]) << "red: neither the backdrop nor a hole";
  EXPECT_GT(raw[0], 2 * raw[2]);
  EXPECT_LT((colour(whole, beside_) - colour(cut, beside_)).abs().maxCoeff(), 3) << "of 255";
}

TEST_F(CutDrawing, HeatMakesItBrown) {
  Cutter cold(shape_), hot(shape_);
  cold.cut(in_slit, false);
  hot.cut(in_slit, true);
  const Eigen::Array3d raw = colour(draw(cold), in_cut_), charred = colour(draw(hot), in_cut_);
  EXPECT_LT(charred[0], raw[0]);
  EXPECT_LT(charred[0] / charred[1], 0.8 * raw[0] / raw[1]) << "less red";
}

TEST_F(CutDrawing, TheMapIsLighterWhereThereIsMore) {
  constexpr float kMiddle = 0.67f;  // of the scale, in the right half of the box
  choices_.map = TissueMap::kStrain;
  std::vector<float> shares;
  for (const Vec3& p : shape_.rest) shares.push_back(p.x() > 0.6 * kBoxSide_m ? kMiddle : 0);
  ASSERT_TRUE(view_->show(0, RemovedSet{}, Cutter(shape_).rest(), shares));
  const Picture picture = draw();
  const Vec3 right{0.8 * kBoxSide_m, 0.5 * kBoxSide_m, kBoxSide_m};
  EXPECT_GT(colour(picture, right)[1], 1.5 * colour(picture, beside_)[1])
      << "green of the middle of the scale";
  EXPECT_GT(colour(picture, beside_)[2], colour(picture, beside_)[0]) << "blue of its beginning";
}

TEST_F(CutDrawing, WholeAgainLooksAsBefore) {
  Cutter cutter(shape_);
  const std::vector<float> rest = cutter.rest();
  draw();
  const Picture before = draw();
  cutter.cut(in_slit, true);
  draw(cutter);
  ASSERT_TRUE(view_->show(0, RemovedSet{}, rest));
  const Picture after = draw();
  int largest = 0;
  for (std::size_t i = 0; i < before.rgba.size(); ++i)
    largest = std::max(largest, std::abs(before.rgba[i] - after.rgba[i]));
  EXPECT_LE(largest, 2) << "rounding: the driver may compile a shader anew";
}

}  // namespace
}  // namespace omentum::render
