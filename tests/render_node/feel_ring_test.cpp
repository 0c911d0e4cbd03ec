#include "render_node/feel_ring.h"

#include "recording_renderer.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr double kFeelLimit_n = 10;
constexpr float kFeelFloat = 1e-4f;

class FeelRingTest : public testing::Test {
 protected:
  std::vector<DrawItem> felt(double force_n, const Vec3& eye = Vec3(0, -0.5, 0.3)) {
    Frame frame;
    frame.view = view_of({eye, {0, 0, 0}, {0, 0, 1}, 40}, {{0, 0, 0}, 0.1}, 1.6f, 0);
    view_ = frame.view;
    ToolNow tool{.seen = true, .p_WT = tip_};
    tool.force_n = {0, force_n, 0};
    ring_.add(tool, kFeelLimit_n, frame);
    return frame.items;
  }
  // Of the ring in the picture, as a share of half its height.
  float radius(const DrawItem& ring) const {
    float most = 0;
    const Eigen::Vector2f middle = in_picture(tip_.cast<float>());
    for (const Vertex& v : renderer_.mesh_of(ring).vertices) {
      const Vec3f at = (ring.W_from_mesh * v.position.homogeneous()).hnormalized();
      most = std::max(most, (in_picture(at) - middle).norm());
    }
    return most;
  }
  // Half heights from the picture's middle.
  Eigen::Vector2f in_picture(const Vec3f& place) const {
    const Eigen::Vector4f clip = view_.clip_from_eye * view_.eye_from_W * place.homogeneous();
    return {1.6f * clip.x() / clip.w(), clip.y() / clip.w()};
  }

  RecordingRenderer renderer_;
  FeelRing ring_{renderer_};
  Vec3 tip_{0.02, 0.01, 0.03};
  View view_;
};

TEST_F(FeelRingTest, IsDrawnOverTheWorldAndAsLargeFromAnywhere) {
  const auto near = felt(0, {0, -0.2, 0.1});
  const float at_rest = radius(near.front());
  EXPECT_NEAR(at_rest, FeelRing::kWide, 0.1f * FeelRing::kWide);
  const auto far = felt(0, {0.6, 0.6, 0.6});
  EXPECT_NEAR(radius(far.front()), at_rest, 0.03f * at_rest);
  for (const DrawItem& item : far) EXPECT_EQ(item.look, Look::kSignal);
  EXPECT_EQ(far.size(), 2U) << "ring and empty bar";
}

TEST_F(FeelRingTest, TightensAndReddensWithTheForce) {
  float wide = 1;
  Vec3f colour(0, 1, 1);
  for (const double force_n : {0.0, 0.1, 1.0, 4.0, 10.0}) {
    const auto items = felt(force_n);
    EXPECT_LT(radius(items.front()), wide) << force_n;
    wide = radius(items.front());
    const Vec3f now = items.front().material.colour;
    EXPECT_LT(now.y(), colour.y()) << force_n;
    colour = now;
  }
  EXPECT_NEAR(wide, FeelRing::kTight * radius(felt(0).front()), 0.02f * FeelRing::kWide);
  EXPECT_NEAR(radius(felt(25).front()), wide, kFeelFloat) << "the limit is the end";
}

TEST_F(FeelRingTest, TheBarIsLinear) {
  const auto length = [](const DrawItem& bar) { return bar.W_from_mesh.block<3, 1>(0, 2).norm(); };
  const auto items = felt(2.5);
  ASSERT_EQ(items.size(), 3U);
  EXPECT_NEAR(length(items[2]), 0.25f * length(items[1]), kFeelFloat);
  const Eigen::Matrix3f axes = items[2].W_from_mesh.topLeftCorner<3, 3>();
  EXPECT_GT(axes.determinant(), 0) << "its outside is seen";
}

TEST_F(FeelRingTest, ATipThatIsNotThereHasNone) {
  Frame frame;
  ring_.add({}, kFeelLimit_n, frame);
  EXPECT_TRUE(frame.items.empty());
  tip_ = {0, -5, 3};  // behind the viewer
  EXPECT_TRUE(felt(1).empty());
}

}  // namespace
}  // namespace omentum::render
