#include "physics/intestine/gut_collisions.h"

#include "physics/intestine/gut_crossings.h"
#include "tests/physics/intestine/restless_gut.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

constexpr double kStep_s = 0.005;

std::vector<double> even_masses(const geometry::GutShape& shape) {
  return std::vector<double>(shape.positions.size(), 0.01);
}

TEST(GutCrossings, AreSeenWhereTheyAreAndNowhereElse) {
  const Way p{Vec3(-1, 0, 1), Vec3(-1, 0, -1)}, q{Vec3(1, 0, 1), Vec3(1, 0, -1)};
  const auto still = [](double x, double y, double z) { return Way{Vec3(x, y, z), Vec3(x, y, z)}; };
  EXPECT_TRUE(edges_meet(p, q, still(0, -1, 0), still(0, 1, 0)));
  EXPECT_FALSE(edges_meet(p, q, still(2, -1, 0), still(2, 1, 0)));
  EXPECT_TRUE(point_meets_triangle(p, still(-2, -1, 0), still(0, -1, 0), still(-1, 1, 0)));
  EXPECT_FALSE(point_meets_triangle(p, still(0, -1, 0), still(2, -1, 0), still(1, 1, 0)));
}

// Without the bound: what such a count can see. With it, intestine_soak_test sees none.
TEST(GutPassage, WithoutTheBoundSuchMotionCrosses) {
  const geometry::GutShape shape = test::folded_gut();
  const GutParts parts(shape);
  GutState state = test::state_of(shape);
  std::mt19937_64 random(7);
  std::int64_t pairs = 0, crossings = 0;
  for (int step = 0; step < 3; ++step) {
    const std::vector<Vec3> before = state.x;
    test::shake(shape.layout, 6, kStep_s, random, state);
    crossings += count_crossings(parts, before, state.x, pairs);
  }
  EXPECT_GT(crossings, 100);
}

// Every mass of a gut as a part's corner: those of a thinner tube, that meet where the thick one's do.
GutParts finest_parts(const geometry::GutShape& shape) {
  geometry::GutShape thin = shape;
  thin.tube_radius_m = (shape.positions[1] - shape.positions[0]).norm();
  GutParts parts(thin);
  parts.near = geometry::neighbourhood(shape);
  return parts;
}

// Where masses are nearer to each other than half a radius, parts span several.
TEST(GutPassage, WhatLiesBetweenThePartsOfAFineGutPassesThroughNothing) {
  const geometry::GutShape shape = test::folded_gut(1000);
  const GutParts finest = finest_parts(shape);
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  ASSERT_EQ(finest.stride, 1);
  ASSERT_GT(collisions.parts().stride, 1);
  GutState state = test::state_of(shape);
  std::mt19937_64 random(3);
  std::int64_t pairs = 0;
  for (int step = 0; step < 3; ++step) {
    const std::vector<Vec3> before = state.x;
    test::shake(shape.layout, 6, kStep_s, random, state);
    collisions.resolve(before, state, {}, {});
    EXPECT_EQ(count_crossings(finest, before, state.x, pairs), 0);
  }
}

// A ribbon, its mesentery 40 cm wide behind it (y), that runs along x, turns up and comes back above itself,
// where one mass of its gut, the tip, hangs low over the middle of a triangle.
constexpr std::int32_t kTip = 12;
geometry::GutShape ribbon_over_itself() {
  geometry::GutShape shape{{2, 16}, std::vector<Vec3>(32), 0.02, 0.01};
  const auto place = [&](std::int32_t column, const Vec3& at) {
    shape.positions[shape.layout.mass(0, column)] = at;
    shape.positions[shape.layout.mass(1, column)] = at + Vec3(0, 0.4, 0);
  };
  for (std::int32_t c = 0; c < 7; ++c) place(c, Vec3(0.2 * c, 0, 0));
  place(7, Vec3(1.4, 0, 0.3));
  for (std::int32_t c = 8; c < 16; ++c) place(c, Vec3(0.467 + 0.2 * (kTip - c), 0, 0.6));
  const auto corner = [&](std::int32_t row, std::int32_t c) {
    return shape.positions[shape.layout.mass(row, c)];
  };
  shape.positions[shape.layout.mass(0, kTip)] =
      (corner(0, 2) + corner(1, 2) + corner(0, 3)) / 3 + Vec3(0, 0, 0.03);
  return shape;
}

// Raghupathi 2004, fig. 13d: a point of the gut comes upon the middle of a triangle of the mesentery, far
// from all of its edges. Tests of segments against segments see nothing there.
TEST(GutPassage, APointOfTheGutStaysOnItsSideOfATrianglesMiddle) {
  const geometry::GutShape shape = ribbon_over_itself();
  const MassId tip = shape.layout.mass(0, kTip);
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  GutState state = test::state_of(shape);
  std::int64_t pairs = 0;
  for (int step = 0; step < 40; ++step) {
    const std::vector<Vec3> before = state.x;
    state.v[tip] = Vec3(0, 0, -1);
    for (std::size_t m = 0; m < state.x.size(); ++m) state.x[m] += kStep_s * state.v[m];
    collisions.resolve(before, state, {}, {});
    ASSERT_EQ(count_crossings(collisions.parts(), before, state.x, pairs), 0);
    ASSERT_LT(collisions.report().deepest_m, 0.05 * shape.tube_radius_m);
  }
  EXPECT_LT(state.x[shape.layout.mass(0, 2)].z(), -0.05);
}

struct Flight {
  double speed, radius_m;
};

class GutProbe : public ::testing::TestWithParam<Flight> {};

// A ball through the middle of the gut and back out, against masses that nothing holds together.
TEST_P(GutProbe, NeverPassesThroughTubeOrMesentery) {
  const auto [speed, radius] = GetParam();
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  const GutParts& parts = collisions.parts();
  GutState state = test::state_of(shape);
  MovingSphere ball{Vec3(0.6, 0.013, 0.11), Vec3(0.6, 0.013, 0.11), radius};
  bool touched = false;
  for (int step = 0; step < std::max(80.0, 1.2 / (speed * kStep_s)); ++step) {
    const std::vector<Vec3> before = state.x;
    ball.after.x() = std::max(-0.6, ball.after.x() - speed * kStep_s);
    for (std::size_t m = 0; m < state.x.size(); ++m) state.x[m] += kStep_s * state.v[m];
    collisions.resolve(before, state, {}, std::span(&ball, 1));
    const SphereOutcome outcome = collisions.outcomes()[0];
    const Way way{ball.before, outcome.reached};
    for (std::int32_t part = parts.layout.segment_count(); part < parts.count(); ++part) {
      const auto& m = parts.masses[static_cast<std::size_t>(part)];
      ASSERT_FALSE(point_meets_triangle(way, {before[m[0]], state.x[m[0]]}, {before[m[1]], state.x[m[1]]},
                                        {before[m[2]], state.x[m[2]]}));
    }
    touched = touched || outcome.impulse.norm() > 0;
    ball.before = outcome.reached;
  }
  EXPECT_TRUE(touched);
}

// at 0.5 and 5 m/s, and at once to the other side
INSTANTIATE_TEST_SUITE_P(Speeds, GutProbe,
                         ::testing::Values(Flight{0.5, 0.01}, Flight{5, 0.01}, Flight{5, 0.002},
                                           Flight{1e3, 0.005}));

}  // namespace
}  // namespace omentum::physics
