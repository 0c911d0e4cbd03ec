#include "geometry/gut_skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace omentum::geometry {
namespace {

constexpr double kRadius_m = 0.02;

/// A gut that waves along x, its mesentery hanging down to a straight vessel.
GutShape wave(std::int32_t columns, double length_m) {
  GutShape shape{
      .layout = {4, columns}, .positions = {}, .tube_radius_m = kRadius_m, .mesentery_thickness_m = 0.01};
  for (std::int32_t row = 0; row < 4; ++row) {
    for (std::int32_t c = 0; c < columns; ++c) {
      const double t = static_cast<double>(c) / (columns - 1), width = 0.15 * std::sin(M_PI * t);
      const Vec3 axis(length_m * t, 0.04 * std::sin(9 * t), 0.01 * std::cos(7 * t));
      shape.positions.push_back(axis - row / 3.0 * width * Vec3(0, 0.3, 1).normalized());
    }
  }
  return shape;
}

std::vector<Vec3> placed(const GutSkin& skin, const std::vector<Vec3>& x) {
  std::vector<Vec3> places(skin.node_count());
  skin.place(x, places);
  return places;
}

TEST(GutSkin, LiesARadiusAroundTheAxisAndAThicknessAroundTheSheet) {
  const GutShape shape = wave(40, 1.0);
  const GutSkin skin(shape);
  const auto places = placed(skin, shape.positions);
  const std::size_t tube = skin.node_count() - 2 * shape.positions.size();
  for (std::size_t n = 0; n < skin.node_count(); ++n) {
    const double off = (places[n] - weighted(skin.node(NodeId(n)), shape.positions)).norm();
    EXPECT_NEAR(off, n < tube ? kRadius_m : 0.005, 1e-12) << n;
  }
}

TEST(GutSkin, WeightsSumToOneSoThatItGoesAlong) {
  const GutSkin skin(wave(40, 1.0));
  for (std::size_t n = 0; n < skin.node_count(); ++n) {
    double sum = 0;
    for (const double w : skin.node(NodeId(n)).weight) sum += w;
    ASSERT_NEAR(sum, 1, 1e-12) << n;
  }
}

TEST(GutSkin, MovesAndTurnsWithTheWhole) {
  const GutShape shape = wave(40, 1.0);
  const GutSkin skin(shape);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 t(0.3, -0.2, 0.1);
  std::vector<Vec3> moved;
  for (const Vec3& x : shape.positions) moved.push_back(R * x + t);
  const auto before = placed(skin, shape.positions), after = placed(skin, moved);
  for (std::size_t n = 0; n < skin.node_count(); ++n)
    EXPECT_LT((after[n] - (R * before[n] + t)).norm(), 1e-9) << n;
}

TEST(GutSkin, TrianglesFaceOutwardAndAreAboutAnEdgeWide) {
  const GutShape shape = wave(40, 1.0);
  const GutSkin skin(shape);
  const auto p = placed(skin, shape.positions);
  const auto tube = static_cast<std::int32_t>(skin.node_count() - 2 * shape.positions.size());
  for (const auto& [a, b, c] : skin.triangles()) {
    const Vec3 normal = (p[static_cast<std::size_t>(b)] - p[static_cast<std::size_t>(a)])
                            .cross(p[static_cast<std::size_t>(c)] - p[static_cast<std::size_t>(a)]);
    const Vec3 out = p[static_cast<std::size_t>(a)] - weighted(skin.node(a), shape.positions);
    EXPECT_GT(normal.dot(out), 0) << a;
    if (a >= tube) continue;
    const double edge_m = (p[static_cast<std::size_t>(b)] - p[static_cast<std::size_t>(a)]).norm();
    EXPECT_LT(edge_m, 1.7 * GutSkin::kSkinEdge_m);
    EXPECT_GT(edge_m, 0.5 * GutSkin::kSkinEdge_m);
  }
}

TEST(GutSkin, TubeIsClosedAllAround) {
  const GutShape shape = wave(40, 1.0);
  const GutSkin skin(shape);
  const auto tube = static_cast<std::int32_t>(skin.node_count() - 2 * shape.positions.size());
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (const auto& t : skin.triangles()) {
    if (t[0] >= tube) continue;
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    open += !edges.contains({edge.second, edge.first});
  }
  EXPECT_EQ(open, 2 * 10u) << "the rims of both ends";
}

TEST(GutSkin, IsAsCoarseForAThousandMassesAsForAHundred) {
  const GutShape coarse = wave(81, 4.0), fine = wave(4001, 4.0);
  const auto rings = [](const GutShape& shape) {
    return (GutSkin(shape).node_count() - 2 * shape.positions.size()) / 10;
  };
  EXPECT_NEAR(static_cast<double>(rings(fine)), static_cast<double>(rings(coarse)),
              0.3 * static_cast<double>(rings(coarse)));
}

TEST(GutSkin, WhatMovesFarAwayTurnsNothingHere) {
  const GutShape shape = wave(100, 4.0);
  const GutSkin skin(shape);
  std::vector<Vec3> bent = shape.positions;
  for (std::int32_t c = 20; c < 30; ++c)
    for (std::int32_t row = 0; row < 3; ++row)
      bent[static_cast<std::size_t>(shape.layout.mass(row, c))] += Vec3(0, 0.1 * (c - 20), 0.05 * (30 - c));
  const auto before = placed(skin, shape.positions), after = placed(skin, bent);
  const std::size_t tube = skin.node_count() - 2 * shape.positions.size();
  for (std::size_t n = tube / 2; n < tube; ++n) ASSERT_LT((after[n] - before[n]).norm(), 1e-9);
}

TEST(GutSkin, IsHeldWhereAllThatCarriesItIs) {
  const GutShape shape = wave(40, 1.0);
  const GutSkin skin(shape);
  EXPECT_TRUE(skin.is_held(NodeId(0))) << "the ring at the held end";
  EXPECT_FALSE(skin.is_held(NodeId(std::size_t{100})));
  EXPECT_TRUE(skin.is_held(NodeId(skin.node_count() - 1))) << "on the vessel";
}

}  // namespace
}  // namespace omentum::geometry
