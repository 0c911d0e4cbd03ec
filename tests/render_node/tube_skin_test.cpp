#include "render_node/tube_skin.h"
#include "closed_mesh.h"
#include "gut_organ.h"
#include "render_node/surface_shading.h"

#include <gtest/gtest.h>

#include <numbers>

namespace omentum::render {
namespace {

using geometry::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kTubeRadius = 0.012;
constexpr double kTubeFloat =
    1e-6;  // m: what positions of some tenths of a metre are rounded to, and some more

std::vector<Vec3> straight(int masses = 21, double length_m = 0.4) {
  std::vector<Vec3> axis;
  for (int i = 0; i < masses; ++i) axis.emplace_back(length_m * i / (masses - 1), 0, 0);
  return axis;
}

/// Two arms side by side, so far apart from middle to middle.
std::vector<Vec3> hairpin(double apart_m) {
  std::vector<Vec3> axis;
  constexpr int kArm = 20, kTurn = 8;
  for (int i = 0; i < kArm; ++i) axis.emplace_back(0.01 * i, 0, 0);
  for (int i = 0; i <= kTurn; ++i)
    axis.emplace_back(0.01 * kArm + apart_m / 2 * std::sin(kPi * i / kTurn),
                      apart_m / 2 * (1 - std::cos(kPi * i / kTurn)), 0);
  for (int i = kArm - 1; i >= 0; --i) axis.emplace_back(0.01 * i, apart_m, 0);
  return axis;
}

std::vector<Vec3> meander() {
  const geometry::GutShape gut = test::gut_shape();
  return {gut.positions.begin(), gut.positions.begin() + gut.layout.columns};
}

TEST(TubeSkin, IsClosedAndItsNormalsPointOutwards) {
  for (const auto& axis : {straight(), meander()}) {
    const TubeSkin skin(axis, kTubeRadius);
    EXPECT_TRUE(test::is_closed(skin.mesh()));
    EXPECT_EQ(test::flipped_triangles(skin.mesh()), 0);
    for (const Vertex& v : skin.mesh().vertices) EXPECT_NEAR(v.normal.norm(), 1, 1e-5f);
  }
}

TEST(TubeSkin, HasTheVolumeOfATube) {
  // a polygon of twenty corners has 98 % of its circle's area
  const TubeSkin skin(straight(), kTubeRadius);
  const double area =
      0.5 * TubeSkin::kAround * std::sin(2 * kPi / TubeSkin::kAround) * kTubeRadius * kTubeRadius;
  const double volume = test::volume_m3(skin.mesh());
  EXPECT_GT(volume, area * 0.4);
  EXPECT_LT(volume, area * (0.4 + 2 * kTubeRadius)) << "two blunt ends";
}

TEST(TubeSkin, WallIsOneRadiusFromTheAxis) {
  const std::vector<Vec3> masses = meander();
  const TubeSkin skin(masses, kTubeRadius);
  geometry::TubeAxis axis(masses.size());
  axis.set(masses);
  std::vector<Vec3> on_axis;
  for (double u = 0; u <= axis.end(); u += 0.01) on_axis.push_back(axis.at(u).place);
  for (const Vertex& v : skin.mesh().vertices) {
    if (v.rest.x() < 0 || v.rest.x() > skin.rest_length_m()) continue;  // a cap
    double nearest = 1;
    for (const Vec3& p : on_axis) nearest = std::min(nearest, (p - v.position.cast<double>()).norm());
    ASSERT_NEAR(nearest, kTubeRadius, 0.002 * kTubeRadius);
  }
}

TEST(TubeSkin, MovesWithItsMassesAndKeepsItsPattern) {
  TubeSkin skin(meander(), kTubeRadius);
  const MeshData before = skin.mesh();
  std::vector<Vec3> moved = meander();
  for (Vec3& p : moved) p += Vec3(0.1, -0.2, 0.05);
  skin.deform(moved);
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    EXPECT_LT(
        (skin.mesh().vertices[i].position - before.vertices[i].position - Vec3f(0.1f, -0.2f, 0.05f)).norm(),
        kTubeFloat);
    EXPECT_LT((skin.mesh().vertices[i].rest - before.vertices[i].rest).norm(), kTubeFloat);
    EXPECT_NEAR(skin.mesh().vertices[i].openness, before.vertices[i].openness, 1e-3f);
  }
}

TEST(TubeSkin, PatternStaysWhereItIsOnTheWallWhileALoopIsPulled) {
  TubeSkin skin(straight(), kTubeRadius);
  std::vector<Vec3> pulled = straight();
  pulled[10].z() += 0.06;
  pulled[9].z() += 0.04;
  pulled[11].z() += 0.04;
  skin.deform(pulled);
  int met = 0;
  for (const Vertex& v : skin.mesh().vertices) {
    if (v.position.x() > 0.08f) continue;  // mass 4 and what is before it did not move
    EXPECT_NEAR(v.rest.x(), v.position.x(), 0.001f);
    ++met;
  }
  EXPECT_GT(met, 100);
}

TEST(TubeSkin, TellsItsLengthNowAndAtRest) {
  TubeSkin skin(straight(), kTubeRadius);
  EXPECT_NEAR(skin.length_m(), 0.4, 1e-12);
  std::vector<Vec3> longer = straight();
  for (Vec3& p : longer) p *= 1.2;
  skin.deform(longer);
  EXPECT_NEAR(skin.length_m(), 0.48, 1e-12);
  EXPECT_NEAR(skin.rest_length_m(), 0.4, 1e-12);
}

TEST(TubeSkin, SharesOfTheMapLieAlongIt) {
  TubeSkin skin(straight(), kTubeRadius);
  std::vector<float> shares(straight().size());
  for (std::size_t m = 0; m < shares.size(); ++m)
    shares[m] = static_cast<float>(m) / static_cast<float>(shares.size() - 1);
  skin.map(shares);
  skin.deform(straight());
  for (const Vertex& v : skin.mesh().vertices)
    EXPECT_NEAR(v.share, std::clamp(v.position.x() / 0.4f, 0.0f, 1.0f), 1e-3f);
}

TEST(TubeSkin, ABendTighterThanTheTubeIsAKinkThatDoesNotTurnInsideOut) {
  for (const double apart : {2.6 * kTubeRadius, 2.0 * kTubeRadius, 1.4 * kTubeRadius}) {
    const TubeSkin skin(hairpin(apart), kTubeRadius);
    EXPECT_TRUE(test::is_closed(skin.mesh()));
    EXPECT_EQ(test::flipped_triangles(skin.mesh()), 0) << apart / kTubeRadius << " radii apart";
  }
}

TEST(TubeSkin, MassesInOnePlaceLeaveItFinite) {
  TubeSkin skin(meander(), kTubeRadius);
  std::vector<Vec3> masses = meander();
  std::fill(masses.begin() + 10, masses.begin() + 20, masses[10]);
  std::fill(masses.begin(), masses.begin() + 4, masses[0]);
  skin.deform(masses);
  EXPECT_TRUE(test::all_finite(skin.mesh()));
  skin.deform(std::vector<Vec3>(masses.size(), Vec3(1, 2, 3)));
  EXPECT_TRUE(test::all_finite(skin.mesh()));
}

TEST(TubeSkin, LoopsShadeEachOtherAndNothingElse) {
  const TubeSkin alone(straight(), kTubeRadius);
  for (const Vertex& v : alone.mesh().vertices) EXPECT_GT(v.openness, 0.99f);
  const TubeSkin side_by_side(hairpin(2.05 * kTubeRadius), kTubeRadius);
  float between = 0, outside = 0;
  int of_between = 0, of_outside = 0;
  for (const Vertex& v : side_by_side.mesh().vertices) {
    if (v.position.x() < 0.05f || v.position.x() > 0.15f || v.position.y() > kTubeRadius) continue;
    if (v.normal.y() > 0.95f) between += v.openness, ++of_between;
    if (v.normal.y() < -0.5f) outside += v.openness, ++of_outside;
  }
  ASSERT_GT(of_between, 0);
  ASSERT_GT(of_outside, 0);
  EXPECT_LT(between / static_cast<float>(of_between), 0.6f);
  EXPECT_GT(outside / static_cast<float>(of_outside), 0.98f);
  for (const Vertex& v : side_by_side.mesh().vertices) EXPECT_GE(v.openness, kDeepestOpenness);
}

}  // namespace
}  // namespace omentum::render
