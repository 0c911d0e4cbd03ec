// The skinned tube as OpenGL draws it, against what the processor computes.
#include "gut_organ.h"
#include "render_node/gl/gl_context.h"
#include "render_node/gl/gl_renderer.h"
#include "render_node/lighting.h"
#include "render_node/organ_look.h"
#include "render_node/tube_cylinder.h"
#include "render_node/tube_frames.h"
#include "render_node/tube_skin.h"

#include <gtest/gtest.h>

#include <numeric>

namespace omentum::render {
namespace {

constexpr Size kPictureSize{320, 240};
constexpr int kBlock = 4;  // pixels: what an eye takes together at arm's length

// Of 255, of blocks: below the first two pictures look the same, side by side; where one of them has straight
// pieces between its frames that is seen, and is above the second.
constexpr double kSameToTheEye = 0.7, kSeen = 1.2;
constexpr double kSameToRounding = 0.2;  // another order of sums moves an edge by a grain

/// The mean difference of blocks of pixels, of 255.
double seen_difference(const Picture& a, const Picture& b) {
  std::vector<double> blocks(static_cast<std::size_t>(kPictureSize.width / kBlock) *
                             static_cast<std::size_t>(kPictureSize.height / kBlock) * 3);
  for (int y = 0; y < kPictureSize.height; ++y)
    for (int x = 0; x < kPictureSize.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto byte = static_cast<std::size_t>(4 * (y * kPictureSize.width + x) + c);
        const int block = 3 * (y / kBlock * (kPictureSize.width / kBlock) + x / kBlock) + c;
        blocks[static_cast<std::size_t>(block)] += (a.rgba[byte] - b.rgba[byte]) / double{kBlock * kBlock};
      }
  const auto add = [](double sum, double of_block) { return sum + std::abs(of_block); };
  return std::accumulate(blocks.begin(), blocks.end(), 0.0, add) / static_cast<double>(blocks.size());
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
    EXPECT_LT(seen_difference(drawn, meshed(mesh)), kSameToRounding) << resolution.eps;
  }
}

TEST_F(SkinnedTube, LooksLikeTheSweptOne) {
  const Picture swept = meshed(TubeSkin(axis_, 0.012).mesh());
  EXPECT_LT(seen_difference(skinned({}), swept), kSameToTheEye);
  EXPECT_LT(seen_difference(skinned(kPictureTube), swept), kSameToTheEye);
  EXPECT_GT(seen_difference(skinned({kCoarsestTubeEps, 0}), swept), kSeen) << "a difference that is seen";
}

TEST_F(SkinnedTube, HasTheColoursOfItsMap) {
  std::vector<float> shares(axis_.size(), 0.8f);
  tube_.map(shares);
  tube_.deform(axis_);
  const Picture drawn = skinned({}, Look::kMap);
  const MeshData mesh =
      skinned_tube(tube_.frames(), tube_.radius_m(), make_tube_cylinder(TubeResolution{}.n));
  EXPECT_LT(seen_difference(drawn, meshed(mesh, Look::kMap)), kSameToRounding);
  EXPECT_GT(seen_difference(drawn, skinned({}, Look::kMap, true)), kSeen) << "its folds are another map";
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
  EXPECT_LT(seen_difference(pale, meshed(mesh)), kSameToRounding);
  EXPECT_GT(seen_difference(pale, red), 5 * kSameToRounding) << "it is seen";
}

TEST_F(SkinnedTube, ItsTrianglesAreShownAsLines) {
  const Picture plain = skinned({});
  scene_.wires = true;
  EXPECT_GT(seen_difference(plain, skinned({})), kSeen);
}

TEST_F(SkinnedTube, OfFewerThanTwoFramesIsNothing) {
  const Picture nothing = draw(scene_);
  Frame frame = scene_;
  frame.tubes.push_back({id_, Look::kGut, {}, tube_.radius_m(), gut_, false});
  EXPECT_EQ(draw(frame).rgba, nothing.rgba);
}

}  // namespace
}  // namespace omentum::render
