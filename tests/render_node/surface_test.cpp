// What is drawn of a deforming surface: normals, openness, refinement, the skin that holds them.
#include "render_node/organ_skin.h"
#include "render_node/surface_shading.h"

#include "ball_organ.h"

#include <gtest/gtest.h>

#include <set>

namespace omentum::render {
namespace {

using test::ball_organ;
using test::dent;

constexpr double kRadius = 0.05;
constexpr float kFloat = 1e-5f;

std::vector<Vec3f> single(const std::vector<Vec3>& points) {
  std::vector<Vec3f> floats;
  for (const Vec3& p : points) floats.push_back(p.cast<float>());
  return floats;
}

TEST(SmoothNormals, PointOutwardOnABall) {
  const OrganShape ball = ball_organ(kRadius, 3);
  std::vector<Vec3f> normals(ball.rest.size(), Vec3f::Zero());
  smooth_normals(ball.surface.triangles, single(ball.rest), normals);
  // 3 splits: edges of 12 degrees; area weighting is off by less than half of one, squared over six
  for (std::size_t s = 0; s < normals.size(); ++s) {
    EXPECT_GT(normals[s].dot(ball.rest[s].normalized().cast<float>()), std::cos(0.06f));
    EXPECT_NEAR(normals[s].norm(), 1, kFloat);
  }
}

TEST(SmoothNormals, TurnWithTheSurface) {
  const OrganShape ball = ball_organ(kRadius, 2);
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(0.8f, Vec3f(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3f> turned;
  for (const Vec3& p : ball.rest) turned.push_back(turn * p.cast<float>());
  std::vector<Vec3f> before(turned.size()), after(turned.size());
  smooth_normals(ball.surface.triangles, single(ball.rest), before);
  smooth_normals(ball.surface.triangles, turned, after);
  for (std::size_t s = 0; s < after.size(); ++s) EXPECT_LT((after[s] - turn * before[s]).norm(), kFloat);
}

TEST(SmoothNormals, NodeWithoutAreaKeepsItsNormal) {
  const OrganShape ball = ball_organ(kRadius, 1);
  std::vector<Vec3f> normals(ball.rest.size(), Vec3f::UnitY());
  smooth_normals(ball.surface.triangles, std::vector<Vec3f>(ball.rest.size(), Vec3f::Zero()), normals);
  for (const Vec3f& n : normals) EXPECT_EQ(n, Vec3f::UnitY());
}

TEST(Openness, BallIsOpenAndADentIsDarkestAtItsBottom) {
  const OrganShape ball = ball_organ(kRadius, 4);
  OrganSkin skin(ball.surface, ball.rest);
  for (const Vertex& v : skin.mesh().vertices) EXPECT_EQ(v.openness, 1);
  skin.deform(dent(ball, ball.rest[4], 0.015, 0.012));
  float darkest = 1;
  for (const Vertex& v : skin.mesh().vertices) {
    EXPECT_GE(v.openness, kDeepestOpenness - kFloat);
    darkest = std::min(darkest, v.openness);
    if (v.rest.z() < 0) {
      EXPECT_GT(v.openness, 0.97) << "far from the dent";
    }
  }
  EXPECT_LT(skin.mesh().vertices[4].openness, 0.8);
  EXPECT_EQ(skin.mesh().vertices[4].openness, darkest);
}

// Every edge of a closed surface has a triangle on either side, running in opposite directions.
void expect_closed(const std::vector<MeshTriangle>& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : triangles) {
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(edges.emplace(t[c], t[(c + 1) % 3]).second) << "an edge twice";
  }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a})) << "an open edge";
}

TEST(SurfaceRefinement, StaysClosedAndSharesItsEdges) {
  const OrganShape ball = ball_organ(kRadius, 2);
  for (const int level : {1, 2, 3, 4}) {
    const SurfaceRefinement refinement(ball.surface.triangles, static_cast<int>(ball.rest.size()), level);
    EXPECT_EQ(refinement.triangles().size(), ball.surface.triangles.size() * level * level);
    // Euler: a ball of F triangles has F / 2 + 2 vertices
    EXPECT_EQ(refinement.vertex_count(), refinement.triangles().size() / 2 + 2);
    expect_closed(refinement.triangles());
  }
}

TEST(SurfaceRefinement, NodesStayAndTheBallBecomesRounder) {
  const OrganShape ball = ball_organ(kRadius, 2);
  const std::vector<Vec3f> positions = single(ball.rest);
  std::vector<Vec3f> normals(positions.size());
  for (std::size_t s = 0; s < positions.size(); ++s) normals[s] = positions[s].normalized();
  const SurfaceRefinement refinement(ball.surface.triangles, static_cast<int>(positions.size()), 3);
  std::vector<Vec3f> curved(refinement.vertex_count());
  refinement.curve(positions, normals, curved);
  for (std::size_t s = 0; s < positions.size(); ++s) EXPECT_LT((curved[s] - positions[s]).norm(), kFloat);

  float flat = 0, round = 0;  // how far the middles of edges lie inside the ball
  for (const auto& t : ball.surface.triangles) {
    const Vec3f middle = (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3;
    flat = std::max(flat, static_cast<float>(kRadius) - middle.norm());
  }
  for (const Vec3f& p : curved) round = std::max(round, std::abs(static_cast<float>(kRadius) - p.norm()));
  EXPECT_LT(round, 0.5 * flat);
}

TEST(SurfaceRefinement, FlatSurfaceStaysFlat) {
  const std::vector<geometry::Triangle> one{
      {geometry::SurfaceId(0), geometry::SurfaceId(1), geometry::SurfaceId(2)}};
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const SurfaceRefinement refinement(one, 3, 4);
  std::vector<Vec3f> curved(refinement.vertex_count());
  refinement.curve(positions, std::vector<Vec3f>(3, Vec3f::UnitZ()), curved);
  for (const Vec3f& p : curved) {
    EXPECT_NEAR(p.z(), 0, kFloat);
    EXPECT_GE(p.minCoeff(), -kFloat);
    EXPECT_LE(p.x() + p.y(), 1 + kFloat);
  }
}

TEST(SurfaceRefinement, LargeMeshesAreNotRefined) {
  EXPECT_EQ(refinement_level(60'000), 1);
  EXPECT_GT(refinement_level(1'500), 1);
  EXPECT_GE(refinement_level(0), 1);
}

TEST(OrganSkin, FollowsItsDisplacements) {
  const OrganShape ball = ball_organ(kRadius, 3);
  OrganSkin skin(ball.surface, ball.rest);
  EXPECT_EQ(skin.largest_displacement_m(), 0);
  EXPECT_NEAR(skin.extent_m(), 2 * kRadius, 1e-9);
  const auto displacements = dent(ball, ball.rest[4], 0.008, 0.01);
  skin.deform(displacements);
  EXPECT_NEAR(skin.largest_displacement_m(), 0.008, 1e-6);
  for (std::size_t s = 0; s < ball.rest.size(); ++s) {
    const Vec3f u = Eigen::Map<const Vec3f>(&displacements[3 * s]);
    EXPECT_LT((skin.position(geometry::SurfaceId(s)) - ball.rest[s].cast<float>() - u).norm(), kFloat);
  }
}

TEST(OrganSkin, PatternSticksToTheTissue) {
  const OrganShape ball = ball_organ(kRadius, 2);
  OrganSkin skin(ball.surface, ball.rest);
  std::vector<Vec3f> before, after;
  for (const Vertex& v : skin.mesh().vertices) before.push_back(v.rest);
  skin.deform(dent(ball, ball.rest[4], 0.008, 0.01));
  for (const Vertex& v : skin.mesh().vertices) after.push_back(v.rest);
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace omentum::render
