#include "render_node/smoke.h"

#include "ball_organ.h"
#include "recording_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::render {
namespace {

using Edges = std::vector<std::optional<Vec3f>>;

const Edges kBurnsAtOrigin{Vec3f::Zero()}, kBurnsNowhere{std::nullopt};

std::vector<DrawItem> puffs_of(const Smoke& smoke) {
  std::vector<DrawItem> items;
  smoke.draw(Vec3f(0, -0.3f, 0.1f), MeshId{7}, items);
  return items;
}
float height_of(const DrawItem& item) {
  return item.W_from_mesh(2, 3);
}
float radius_of(const DrawItem& item) {
  return item.W_from_mesh.col(0).head<3>().norm();
}

TEST(Smoke, OnlyAnEdgeThatBurnsSmokes) {
  Smoke smoke;
  smoke.advance(kBurnsNowhere, 1);
  EXPECT_TRUE(puffs_of(smoke).empty());
  smoke.advance(kBurnsAtOrigin, 0.01);
  EXPECT_EQ(puffs_of(smoke).size(), 1u) << "at once";
}

TEST(Smoke, RisesWidensAndFadesAway) {
  Smoke smoke;
  smoke.advance(kBurnsAtOrigin, 0.01);
  DrawItem last = puffs_of(smoke).front();
  for (int k = 0; k < 4; ++k) {
    smoke.advance(kBurnsNowhere, 0.3);
    ASSERT_EQ(smoke.puff_count(), 1u);
    const DrawItem now = puffs_of(smoke).front();
    EXPECT_GT(height_of(now), height_of(last));
    EXPECT_GT(radius_of(now), radius_of(last));
    EXPECT_LT(now.material.opacity, last.material.opacity);
    EXPECT_GE(now.material.opacity, 0);
    last = now;
  }
  smoke.advance(kBurnsNowhere, Smoke::kLife_s);
  EXPECT_EQ(smoke.puff_count(), 0u);
}

TEST(Smoke, IsBoundedHoweverLongItBurnsAndHoweverLongAFrameTakes) {
  Smoke smoke;
  constexpr double kMost = 2 * (Smoke::kLife_s / Smoke::kPeriod_s + 2);
  const Edges two{Vec3f::Zero(), Vec3f::UnitX()};
  for (int k = 0; k < 300; ++k) {
    smoke.advance(two, 0.033);
    EXPECT_LE(static_cast<double>(smoke.puff_count()), kMost);
  }
  smoke.advance(two, 3600);
  EXPECT_LE(static_cast<double>(smoke.puff_count()), kMost);
}

TEST(Smoke, NoFrameRateShows) {
  Smoke slow, fast;
  for (int k = 0; k < 8; ++k) slow.advance(kBurnsAtOrigin, 0.125);
  for (int k = 0; k < 128; ++k) fast.advance(kBurnsAtOrigin, 1.0 / 128);
  const std::vector<DrawItem> a = puffs_of(slow), b = puffs_of(fast);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT((a[i].W_from_mesh - b[i].W_from_mesh).norm(), 1e-4f);
    EXPECT_NEAR(a[i].material.opacity, b[i].material.opacity, 1e-4f);
  }
}

TEST(Smoke, IsDrawnFacingTheEyeTheFarthestPuffFirst) {
  Smoke smoke;
  for (int k = 0; k < 20; ++k) smoke.advance({{Vec3f(0.01f * static_cast<float>(k % 7), 0, 0)}}, 0.05);
  const Vec3f eye(0, -0.3f, 0.1f);
  float last = 1;
  for (const DrawItem& item : puffs_of(smoke)) {
    const Vec3f to_eye = eye - item.W_from_mesh.topRightCorner<3, 1>();
    EXPECT_GT(item.W_from_mesh.col(2).head<3>().dot(to_eye.normalized()), 0.999f);
    EXPECT_LE(to_eye.norm(), last + 1e-6f);
    last = to_eye.norm();
  }
}

TEST(Smoke, ComesFromTheHookThatCutsAndIsInNoCloseUp) {
  RecordingRenderer renderer;
  SceneView view(test::scene_with({"probe"}), std::vector{test::ball_organ(0.05, 2)}, renderer);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  std::vector<ToolNow> tools{test::tool_at(Vec3(0, 0, 0.05), Vec3::Zero())};
  const auto puffs = [](const Frame& frame) {
    return std::ranges::count(frame.items, Look::kSmoke, &DrawItem::look);
  };
  view.smoke(tools, 0.5);
  EXPECT_EQ(puffs(view.frame(choices, tools, 0)), 0);
  tools[0].burning_at = Vec3(0.01, 0.02, 0.05);
  view.smoke(tools, 0.01);
  const Frame frame = view.frame(choices, tools, 0);
  ASSERT_EQ(puffs(frame), 1);
  const auto puff = std::ranges::find(frame.items, Look::kSmoke, &DrawItem::look);
  EXPECT_LT((puff->W_from_mesh.topRightCorner<3, 1>() - Vec3f(0.01f, 0.02f, 0.05f)).norm(), 0.01f);
  EXPECT_EQ(renderer.mesh_of(*puff).triangles.size(), 2u);
  EXPECT_EQ(puffs(view.close_up({}, choices, tools)), 0);
}

}  // namespace
}  // namespace omentum::render
