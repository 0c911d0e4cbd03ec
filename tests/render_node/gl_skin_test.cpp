// The skinned tube as OpenGL draws it, against what the processor computes.
#include "gut_organ.h"
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/lighting.h"
#include "render_node/organ_look.h"
#include "render_node/tube_cylinder.h"
#include "render_node/tube_frames.h"
#include "render_node/tube_skin.h"
#include "seen_difference.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr Size kPictureSize{320, 240};
constexpr double kSameToRounding = 0.05;  // another order of sums moves an edge by a grain

/// Their mean difference, as an eye sees it.
double mean_difference(const Picture& a, const Picture& b) {
  return test::seen_difference_of(a, b).mean;
}

class SkinnedTube : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = gl::open_offscreen(kPictureSize);
    } catch (const gl::DisplayError& error) {
      GTEST_SKIP() << error.what();
    }
    Ball ball = ball_around(axis_);
    ball.radius *= 0.6;
    const Camera camera = start_camera({}, ball, {0.2, -0.6, 1}, kPictureSize.aspect());
    scene_.view = view_of(camera, ball, kPictureSize.aspect(), 0);
    scene_.lighting = light_scene(camera, ball);
    scene_.with_panel = false;
    id_ = renderer_->add_tube();
  }
  static std::vector<geometry::Vec3> gut_axis() {
    const geometry::GutShape gut = test::gut_shape();
    return {gut.positions.begin(), gut.positions.begin() + gut.layout.columns};
  }
  Picture draw(const Frame& frame) {
    renderer_->draw(frame);
    return renderer_->read_back();
  }
  Picture skinned(const TubeResolution& resolution, Look look = Look::kGut, bool by_turn = false) {
    tube_.set_eps(resolution.eps);
    renderer_->update_tube(id_, tube_.frames());
    Frame frame = scene_;
    frame.tubes.push_back({id_, look, resolution, tube_.radius_m(), gut_, by_turn});
    return draw(frame);
  }
  Picture meshed(const MeshData& mesh, Look look = Look::kGut) {
    Frame frame = scene_;
    frame.items.push_back({renderer_->add_mesh(mesh), look, Mat4f::Identity(), gut_});
    return draw(frame);
  }

  std::vector<geometry::Vec3> axis_ = gut_axis();
  TubeFrames tube_{axis_, 0.012};
  Material gut_ = tissue_material("gut");
  Frame scene_;
  std::unique_ptr<Renderer> renderer_;
  TubeId id_{};
};

TEST_F(SkinnedTube, IsWhatTheProcessorComputesOfItsFrames) {
  for (const TubeResolution& resolution : {TubeResolution{}, TubeResolution{kCoarsestTubeEps, 1}}) {
    const Picture drawn = skinned(resolution);
    const MeshData mesh = skinned_tube(tube_.frames(), tube_.radius_m(), make_tube_cylinder(resolution.n));
    EXPECT_LT(mean_difference(drawn, meshed(mesh)), kSameToRounding) << resolution.eps;
  }
}

TEST_F(SkinnedTube, LooksLikeTheSweptOne) {
  const Picture swept = meshed(TubeSkin(axis_, 0.012).mesh());
  EXPECT_LT(mean_difference(skinned({}), swept), test::kSameMean);
  EXPECT_LT(mean_difference(skinned(kPictureTube), swept), test::kSameMean);
  EXPECT_GT(mean_difference(skinned({kCoarsestTubeEps, 0}), swept), test::kSameMean)
      << "a difference that is seen";
}

TEST_F(SkinnedTube, HasTheColoursOfItsMap) {
  std::vector<float> shares(axis_.size(), 0.8f);
  tube_.map(shares);
  tube_.deform(axis_);
  const Picture drawn = skinned({}, Look::kMap);
  const MeshData mesh =
      skinned_tube(tube_.frames(), tube_.radius_m(), make_tube_cylinder(TubeResolution{}.n));
  EXPECT_LT(mean_difference(drawn, meshed(mesh, Look::kMap)), kSameToRounding);
  EXPECT_GT(mean_difference(drawn, skinned({}, Look::kMap, true)), test::kSameMean)
      << "its folds are another map";
}

TEST_F(SkinnedTube, PalesAsItsMeshDoes) {
  const Picture red = skinned({});
  std::vector<Press> presses;  // from above, all along it
  for (const SkinFrame& frame : tube_.frames())
    presses.push_back({frame.origin + tube_.radius_m() * Vec3f::UnitZ(), Vec3f::UnitZ(), 1});
  ASSERT_TRUE(tube_.live(presses, 1));
  const Picture pale = skinned({});
  const MeshData mesh =
      skinned_tube(tube_.frames(), tube_.radius_m(), make_tube_cylinder(TubeResolution{}.n));
  EXPECT_LT(mean_difference(pale, meshed(mesh)), kSameToRounding);
  EXPECT_GT(mean_difference(pale, red), 5 * kSameToRounding) << "it is seen";
}

TEST_F(SkinnedTube, ItsTrianglesAreShownAsLines) {
  const Picture plain = skinned({});
  scene_.wires = true;
  EXPECT_GT(mean_difference(plain, skinned({})), test::kSameMean);
}

TEST_F(SkinnedTube, OfFewerThanTwoFramesIsNothing) {
  const Picture nothing = draw(scene_);
  Frame frame = scene_;
  frame.tubes.push_back({id_, Look::kGut, {}, tube_.radius_m(), gut_, false});
  EXPECT_EQ(draw(frame).rgba, nothing.rgba);
}

}  // namespace
}  // namespace omentum::render
