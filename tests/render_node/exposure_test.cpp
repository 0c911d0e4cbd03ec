#include "render_node/exposure_raster.h"
#include "render_node/exposure_score.h"

#include "render_node/camera.h"
#include "render_node/solids.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::render {
namespace {

constexpr Size kSize{160, 120};
constexpr double kPixel = 0.02;  // of a share: a square's edge runs through pixels

/// A square across the camera's way, its middle there, m.
MeshData square(const Vec3& middle, double side) {
  MeshData mesh;
  for (const auto& [x, z] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    mesh.vertices.emplace_back().position = (middle + side * Vec3(x, 0, z)).cast<float>();
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Looks along y from `away` metres before the origin.
View from(double away, double field_of_view_deg = 40) {
  const Camera camera{Vec3(0, -away, 0), Vec3::Zero(), Vec3::UnitZ(), field_of_view_deg};
  return view_of(camera, {Vec3::Zero(), 0.2}, kSize.aspect(), 0);
}

std::optional<double> exposed(const MeshData& thing, const std::vector<MeshData>& covers,
                              const View& view = from(1)) {
  ExposureRaster raster(kSize);
  raster.look(view);
  raster.add_thing(thing);
  for (const MeshData& cover : covers) raster.add_cover(cover);
  return raster.share();
}

const MeshData kThing = square(Vec3::Zero(), 0.3);

TEST(ExposureRaster, WhatNothingHidesIsExposed) {
  EXPECT_EQ(exposed(kThing, {}), 1.0);
  EXPECT_EQ(exposed(kThing, {square({0, 0.1, 0}, 1)}), 1.0) << "that is behind it";
  EXPECT_EQ(exposed(kThing, {square({0.4, -0.1, 0}, 0.2)}), 1.0) << "that is beside it";
}

TEST(ExposureRaster, ASquareThatReachesHalfOverAnotherHidesHalfOfIt) {
  // nearer by a tenth: its edge through the middle stays there
  EXPECT_NEAR(*exposed(kThing, {square({0.2, -0.1, 0}, 0.4)}), 0.5, kPixel);
  EXPECT_NEAR(*exposed(kThing, {square({0, -0.1, 0.2}, 0.4)}), 0.5, kPixel);
}

TEST(ExposureRaster, WhatIsHiddenTwiceCountsOnce) {
  const MeshData cover = square({0.2, -0.1, 0}, 0.4);
  EXPECT_EQ(exposed(kThing, {cover, cover}), exposed(kThing, {cover}));
  const MeshData other = square({0, -0.2, 0.2}, 0.4);
  EXPECT_NEAR(*exposed(kThing, {cover, other}), 0.25, kPixel);
  EXPECT_EQ(exposed(kThing, {cover, other}), exposed(kThing, {other, cover}));
}

TEST(ExposureRaster, NothingIsExposedBehindAWall) {
  EXPECT_EQ(exposed(kThing, {square({0, -0.2, 0}, 1)}), 0.0);
}

TEST(ExposureRaster, WhatIsOutOfSightHasNoShare) {
  EXPECT_FALSE(exposed(square({2, 0, 0}, 0.1), {}).has_value());
  EXPECT_FALSE(exposed(square({0, -2, 0}, 0.1), {}).has_value()) << "behind the camera";
}

TEST(ExposureRaster, OnlyWhatIsInThePictureCounts) {
  // the border runs through the thing, and what hides it ends there
  const View view = from(1, 20);
  const double half_width = std::tan(10 * std::numbers::pi / 180) * kSize.aspect();
  const MeshData thing = square({-half_width, 0, 0}, 0.2);
  EXPECT_EQ(exposed(thing, {}, view), 1.0);
  const MeshData cover = square({-0.9 * half_width - 0.5, -0.1, 0}, 1);
  EXPECT_EQ(exposed(thing, {cover}, view), 1.0) << "it ends at the picture's border";
}

TEST(ExposureRaster, ACoverThatReachesBehindTheCameraIsCutAtTheNearPlane) {
  // a wall along the way of sight, from behind the eye to the thing, just right of the middle: it hides
  // nothing of a thing to its left, and all of one to its right
  MeshData wall;
  for (const Vec3f& p :
       {Vec3f(0.01f, -3, -1), Vec3f(0.01f, 0.5f, -1), Vec3f(0.01f, 0.5f, 1), Vec3f(0.01f, -3, 1)})
    wall.vertices.emplace_back().position = p;
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(exposed(square({-0.1, 0, 0}, 0.1), {wall}), 1.0);
  EXPECT_EQ(exposed(square({0.2, 0, 0}, 0.1), {wall}), 0.0);
}

TEST(ExposureRaster, ABallHidesItsDisc) {
  MeshData ball = unit_ball();
  for (Vertex& v : ball.vertices) v.position *= 0.1f;
  const double seen_radius = 0.1 / std::sqrt(1 - 0.01);  // of its outline, in the plane through its middle
  const double share = 1 - std::numbers::pi * seen_radius * seen_radius / (0.3 * 0.3);
  const MeshData behind = square({0, 0.0, 0}, 0.3);
  ExposureRaster raster(kSize);
  raster.look(from(1));
  raster.add_thing(behind);
  raster.add_cover(ball);
  EXPECT_NEAR(*raster.share(), share, 0.03);
  raster.look(from(1));
  raster.add_thing(behind);
  Mat4f aside = Mat4f::Identity();
  aside(0, 3) = 1;
  raster.add_cover(ball, aside);
  EXPECT_EQ(raster.share(), 1.0) << "its pose is heard";
}

TEST(ExposureScore, KeepsTheFirstTheNewestAndTheLargest) {
  ExposureScore score;
  EXPECT_TRUE(to_json(score)["first"].is_null());
  for (const double share : {0.2, 0.7, 0.5}) score.add(share);
  EXPECT_EQ(to_json(score), (nlohmann::json{{"first", 0.2}, {"newest", 0.5}, {"largest", 0.7}}));
}

}  // namespace
}  // namespace omentum::render
