// What is seen around organs.
#include "render_node/scenery.h"
#include "ball_organ.h"
#include "recording_renderer.h"
#include "render_node/draw_order.h"
#include "render_node/scene_view.h"

#include "geometry/tetra_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace omentum::render {
namespace {

constexpr double kRoom_m = 0.3, kHeldBall_m = 0.05;

/// A ball with a ridge, inwards, around its equator.
SceneryPiece ball_scenery(const std::string& look, double radius_m, double ridge_m = 0) {
  const OrganShape ball = test::ball_organ(radius_m, 5);
  std::vector<Vec3> places = ball.rest;
  for (Vec3& p : places) p *= 1 - ridge_m / radius_m * std::exp(-std::pow(p.z() / 0.02, 2));
  return make_scenery(places, ball.surface.triangles, look);
}

TEST(SceneryPiece, AWallIsSeenFromInsideAndEverythingElseFromOutside) {
  for (const auto& [look, outwards] : {std::pair("wall", -1.0f), std::pair("omentum", 1.0f)}) {
    const SceneryPiece piece = ball_scenery(look, kRoom_m);
    EXPECT_EQ(piece.look, outwards < 0 ? Look::kWall : Look::kTissue);
    ASSERT_FALSE(piece.mesh.triangles.empty());
    for (const auto& [a, b, c] : piece.mesh.triangles) {
      const Vec3f p = piece.mesh.vertices[a].position, q = piece.mesh.vertices[b].position,
                  r = piece.mesh.vertices[c].position;
      ASSERT_GT(outwards * (q - p).cross(r - p).dot(p), 0);
      ASSERT_GT(outwards * piece.mesh.vertices[a].normal.dot(p), 0);
    }
  }
}

TEST(SceneryPiece, AWallIsPaleOverARidgeAlone) {
  for (const Vertex& v : ball_scenery("wall", kRoom_m).mesh.vertices) ASSERT_EQ(v.pallor, 0);
  float on_ridge = 0, off_ridge = 0;
  for (const Vertex& v : ball_scenery("wall", kRoom_m, 0.012).mesh.vertices) {
    float& most = std::abs(v.position.z()) < 0.005f ? on_ridge : off_ridge;
    if (std::abs(v.position.z()) < 0.005f || std::abs(v.position.z()) > 0.1f)
      most = std::max(most, v.pallor);
  }
  EXPECT_GT(on_ridge, 0.1f);
  EXPECT_EQ(off_ridge, 0);
}

struct Surrounded {
  explicit Surrounded(const std::string& look) {
    view.surround({ball_scenery(look, kRoom_m)});
    choices.orbit = view.first_camera();
  }
  bool shows(Look look) const {
    const Frame frame = view.frame(choices, {}, 0);
    return std::ranges::any_of(frame.items, [&](const DrawItem& item) { return item.look == look; });
  }
  scene::Scene scene;
  RecordingRenderer renderer;
  SceneView view{scene, std::vector{test::ball_organ(kHeldBall_m, 4)}, renderer};
  ViewChoices choices;
};

TEST(Scenery, IsSentOnceAndDrawnInEveryFrame) {
  Surrounded organ("wall");
  const std::size_t meshes = organ.renderer.meshes.size();
  const int sent = organ.renderer.updates;
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(organ.shows(Look::kWall));
  organ.view.refresh(0);
  EXPECT_EQ(organ.renderer.meshes.size(), meshes);
  EXPECT_EQ(organ.renderer.updates, sent);
}

TEST(Scenery, WithinAWallThereIsNoDrape) {
  EXPECT_FALSE(Surrounded("wall").shows(Look::kGround));
  EXPECT_TRUE(Surrounded("omentum").shows(Look::kGround));
}

TEST(Scenery, OrgansShadeItWhereTheyAreNear) {
  const Surrounded organ("wall");
  float nearest = 1, farthest = 0;
  for (const Vertex& v : organ.renderer.meshes.back().vertices) {
    nearest = std::min(nearest, v.openness);
    farthest = std::max(farthest, v.openness);
  }
  EXPECT_LT(nearest, 0.99f);
  EXPECT_GT(nearest, 0.9f) << "a ball of 5 cm in the middle of 30 is a small part of the sky";
  EXPECT_LE(farthest, 1);
}

TEST(Scenery, AWallDarkensNothing) {
  EXPECT_FALSE(casts_shadow(Look::kWall));
}

TEST(Scenery, WhatNobodyMadeIsLeftOutAndABadFileIsNamed) {
  EXPECT_TRUE(load_scenery(std::vector{scene::ScenerySpec{.mesh = "phantom:cavity"}}).empty());
  const auto file = std::filesystem::path(::testing::TempDir()) / "no_scenery.msh";
  std::filesystem::remove(file);
  try {
    load_scenery(std::vector{scene::ScenerySpec{.mesh = file.string(), .file = file}});
    FAIL() << "accepted";
  } catch (const geometry::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no_scenery.msh"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omentum::render
