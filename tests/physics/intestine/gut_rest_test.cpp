#include "physics/intestine/gut_system.h"

#include "tests/physics/intestine/crossings.h"
#include "tests/physics/intestine/restless_gut.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::Vec3;

GutObstacle floor_below(const geometry::GutShape& shape, double below_m) {
  double lowest = 0;
  for (const Vec3& p : shape.positions) lowest = std::min(lowest, p.z());
  return {.centre = Vec3(0, 0, lowest - below_m)};
}

double mean_speed(const GutState& state) {
  double sum = 0;
  for (const Vec3& v : state.v) sum += v.norm();
  return sum / static_cast<double>(state.v.size());
}

// Folds that lie across each other, on their mesentery and on a plane, 10 s after they were let go.
TEST(GutRest, FoldsOnAPlaneComeToRestAndOverlapByLessThanATwentiethOfTheRadius) {
  const geometry::GutShape shape = test::folded_gut();
  const GutObstacle floor = floor_below(shape, 0.05);
  GutSystem gut(shape, GutMaterial{}, {}, {.step_s = 0.002});
  double deepest = 0;
  for (int step = 0; step < 5000; ++step) {
    gut.step({.obstacles = std::span(&floor, 1)});
    deepest = std::max(deepest, step < 4500 ? 0 : gut.report().collisions.deepest_m);
  }
  EXPECT_GT(gut.report().collisions.contacts, 50);
  EXPECT_LT(mean_speed(gut.state()), 1e-3);
  EXPECT_LT(deepest, 0.05 * shape.tube_radius_m);
  const GutParts parts(shape);
  const geometry::GutOverlaps overlaps = geometry::all_overlaps(
      parts.layout, gut.state().x, {0.95 * parts.reach.tube_m, 0.95 * parts.reach.mesentery_m}, parts.near);
  EXPECT_TRUE(overlaps.empty());
}

// The force on a ball that is held under a fold, as a mean over steps: the springs', whatever the step.
double force_on_ball(double step_s) {
  const geometry::GutShape shape = test::folded_gut();
  GutSystem gut(shape, GutMaterial{}, {}, {.step_s = step_s});
  Vec3 place = shape.positions[shape.layout.mass(0, 50)] + Vec3(0, 0, 0.2);
  MovingSphere ball{place, place, 0.03};
  const int steps = static_cast<int>(6 / step_s);
  double force = 0;
  for (int step = 0; step < steps; ++step) {
    gut.step({.spheres = std::span(&ball, 1)});
    ball.before = gut.outcomes()[0].reached;
    if (step >= steps * 3 / 4) force += gut.outcomes()[0].impulse.norm() / step_s / (steps / 4.0);
  }
  return force;
}

TEST(GutRest, TheForceOnABallDoesNotDependOnTheStep) {
  const double coarse = force_on_ball(0.005), fine = force_on_ball(0.0025);
  EXPECT_GE(coarse, 0);
  EXPECT_NEAR(coarse, fine, 0.1 * fine);
}

}  // namespace
}  // namespace omentum::physics
