// Normals and openness from flat tables say what the plain functions say.
#include "render_node/shading_net.h"

#include "ball_organ.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

using geometry::Triangle;

constexpr double kBallRadius_m = 0.05;
constexpr float kHorizonOfBall_m = 0.018f;
// Kernels of one width but of another form: a twentieth of the light, where a hollow takes a third.
constexpr float kOpennessApart = 0.05f;

struct Dented {
  explicit Dented(int splits) : ball(test::ball_organ(kBallRadius_m, splits)) {
    const std::vector<float> u = test::dent(ball, ball.rest[4], 0.006, 0.012);
    for (std::size_t s = 0; s < ball.rest.size(); ++s) {
      rest.push_back(ball.rest[s].cast<float>());
      positions.push_back(rest.back() + Eigen::Map<const Vec3f>(&u[3 * s]));
    }
  }
  OrganShape ball;
  std::vector<Vec3f> rest, positions;
};

std::vector<Vec3f> plain_normals(std::span<const Triangle> triangles, std::span<const Vec3f> positions) {
  std::vector<Vec3f> normals(positions.size(), Vec3f::UnitZ());
  smooth_normals(triangles, positions, normals);
  return normals;
}

// Largest difference of both ways; `darkest`: of the plain one.
float openness_apart(std::span<const Triangle> triangles, const Dented& dented, float& darkest) {
  const std::vector<Vec3f> normals = plain_normals(triangles, dented.positions);
  std::vector<float> plain(normals.size()), flat(normals.size());
  openness_of(triangles, dented.positions, normals, kHorizonOfBall_m, plain);
  ShadingNet net(triangles, dented.rest, kHorizonOfBall_m);
  net.find_openness(dented.positions, normals, flat);
  float apart = 0;
  for (std::size_t s = 0; s < flat.size(); ++s) apart = std::max(apart, std::abs(flat[s] - plain[s]));
  darkest = *std::ranges::min_element(plain);
  return apart;
}

TEST(ShadingNet, NormalsAreThoseOfThePlainWay) {
  const Dented dented(4);
  ShadingNet net(dented.ball.surface.triangles, dented.rest, kHorizonOfBall_m);
  std::vector<Vec3f> normals(dented.rest.size(), Vec3f::Zero());
  net.find_normals(dented.positions, normals);
  const std::vector<Vec3f> plain = plain_normals(dented.ball.surface.triangles, dented.positions);
  for (std::size_t s = 0; s < normals.size(); ++s) EXPECT_LT((normals[s] - plain[s]).norm(), 1e-5f);
}

// 3 splits: so few steps that they are taken one by one; 5: 16 of them in 8.
TEST(ShadingNet, OpennessIsThatOfThePlainWay) {
  for (const int splits : {3, 4, 5}) {
    float darkest = 1;
    const Dented dented(splits);
    EXPECT_LT(openness_apart(dented.ball.surface.triangles, dented, darkest), kOpennessApart) << splits;
    EXPECT_LT(darkest, 0.8f) << "a dent that is seen, " << splits;
  }
}

TEST(ShadingNet, AnOpenSurfaceWeighsItsRimAsThePlainWayDoes) {
  const Dented dented(3);
  const std::span<const Triangle> half = std::span(dented.ball.surface.triangles).first(200);
  float darkest = 1;
  EXPECT_LT(openness_apart(half, dented, darkest), 1e-4f);
}

TEST(ShadingNet, WhatHasNoTriangleStaysAsItIs) {
  const std::vector<Vec3f> points(4, Vec3f::UnitY());
  ShadingNet net({}, points, kHorizonOfBall_m);
  std::vector<Vec3f> normals(4, Vec3f::UnitX());
  std::vector<float> openness(4, 0.0f);
  net.find_normals(points, normals);
  net.find_openness(points, normals, openness);
  for (std::size_t s = 0; s < 4; ++s) {
    EXPECT_EQ(normals[s], Vec3f::UnitX());
    EXPECT_EQ(openness[s], 1);
  }
}

TEST(FlatLinks, VisitsEachNodeOnceWithItsLinksInOrder) {
  const std::vector<std::vector<std::int32_t>> all{{2, 0, 1}, {}, {5}, {1, 1, 1}, {4}};
  std::vector<int> visits(all.size(), 0);
  FlatLinks(all).each([&](std::size_t node, std::span<const std::int32_t> links) {
    ++visits[node];
    EXPECT_TRUE(std::ranges::equal(links, all[node])) << node;
  });
  EXPECT_EQ(visits, std::vector<int>(all.size(), 1));
}

}  // namespace
}  // namespace omentum::render
