#include "physics/intestine/gut_system.h"

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

// Planes this far below the vessel, steps of 5 ms: piles that trembled by 24 and 18 mm/s as long as contacts
// came behind the springs' iterations.
class GutPile : public ::testing::TestWithParam<double> {};

TEST_P(GutPile, LiesStillTenSecondsAfterItWasLetGo) {
  GutSystem gut(test::folded_gut(), GutMaterial{}, {}, {.step_s = 0.005});
  const GutObstacle floor{.centre = Vec3(0, 0, -GetParam())};
  double last_second = 0;
  for (int step = 0; step < 2000; ++step) {
    gut.step({.obstacles = std::span(&floor, 1)});
    if (step >= 1800) last_second += mean_speed(gut.state()) / 200;
  }
  EXPECT_LT(last_second, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Planes, GutPile, ::testing::Values(0.065, 0.1));

// What springs and weight do to all free masses together, N: of a gut at rest it is what else holds it.
Vec3 springs_and_weight(const GutSystem& gut) {
  const std::vector<Vec3> still(gut.state().x.size(), Vec3::Zero());
  std::vector<Vec3> forces(still.size(), Vec3::Zero());
  gut.springs().forces(gut.state().x, still, forces);
  Vec3 sum = Vec3::Zero();
  for (std::int32_t m = 0; m < gut.shape().layout.mass_count(); ++m) {
    if (gut.shape().layout.is_held(geometry::MassId(m))) continue;
    sum += forces[static_cast<std::size_t>(m)] +
           gut.springs().mass()[static_cast<std::size_t>(m)] * gut.settings().gravity_m_s2;
  }
  return sum;
}

// A short gut straight below its vessel: it touches itself nowhere.
geometry::GutShape curtain() {
  geometry::GutShape shape{{3, 12}, std::vector<Vec3>(36), 0.02, 0.01};
  for (std::int32_t c = 0; c < 12; ++c) {
    const double down = 0.15 * std::min({1.0, c / 3.0, (11 - c) / 3.0});
    for (std::int32_t r = 0; r < 3; ++r)
      shape.positions[shape.layout.mass(r, c)] = Vec3(0.05 * c, 0, -down * (2 - r) / 2);
  }
  return shape;
}

// Of the force: what the iterations leave over.
constexpr double kShareOfError = 0.01;

class GutBall : public ::testing::TestWithParam<double> {};

// It is pushed 4 cm aside by a ball. The impulse on the ball, by the step, is the force that the gut needs to
// hang like that, whatever the step: the matrix of an implicit step, stiffer than the springs, is not in it.
TEST_P(GutBall, FeelsTheForceThatTheGutNeedsToHang) {
  const double step_s = GetParam();
  GutSystem gut(curtain(), GutMaterial{}, {}, {.step_s = step_s});
  MovingSphere ball{Vec3(0.275, -0.06, -0.15), Vec3(0.275, -0.01, -0.15), 0.03};
  const int steps = static_cast<int>(8 / step_s), measured = static_cast<int>(0.5 / step_s);
  Vec3 force = Vec3::Zero();
  for (int step = 0; step < steps; ++step) {
    gut.step({.spheres = std::span(&ball, 1)});
    ball.before = gut.outcomes()[0].reached;
    if (step >= steps - measured) force += gut.outcomes()[0].impulse / step_s / measured;
  }
  const Vec3 expected = springs_and_weight(gut);
  EXPECT_GT(expected.norm(), 0.5);
  EXPECT_LT((force - expected).norm(), kShareOfError * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Steps, GutBall, ::testing::Values(0.01, 0.005, 0.002));

// A probe right through the gut, by a hand of 20 N: loops are pushed aside, and where the mesentery holds
// them the probe stays behind.
class GutDrive : public ::testing::TestWithParam<double> {};

TEST_P(GutDrive, AProbeThatIsDrivenThroughOverlapsByLessThanATwentiethOfTheRadius) {
  constexpr double kStep_s = 0.0025, kHand_n = 20;
  const geometry::GutShape shape = test::folded_gut();
  const GutObstacle floor = floor_below(shape, 0.02);
  GutSystem gut(shape, GutMaterial{}, {}, {.step_s = kStep_s});
  for (int step = 0; step < 200; ++step) gut.step({.obstacles = std::span(&floor, 1)});
  const Vec3 from(0.03, 0.4, 0.05), to(0.03, -0.4, 0.05);
  MovingSphere ball{.before = from, .after = from, .radius_m = 0.01, .most_force_n = kHand_n};
  double deepest_m = 0, hardest_n = 0;
  for (double way = 0; way < 1; way += GetParam() * kStep_s / (to - from).norm()) {
    ball.after = from + way * (to - from);
    gut.step({.obstacles = std::span(&floor, 1), .spheres = std::span(&ball, 1)});
    ball.before = gut.outcomes()[0].reached;
    deepest_m = std::max(deepest_m, gut.report().collisions.deepest_m);
    hardest_n = std::max(hardest_n, gut.outcomes()[0].impulse.norm() / kStep_s);
  }
  EXPECT_GT(hardest_n, 1);
  EXPECT_LT(hardest_n, 1.2 * kHand_n);
  EXPECT_LT(deepest_m, 0.05 * shape.tube_radius_m);
}

INSTANTIATE_TEST_SUITE_P(Speeds, GutDrive, ::testing::Values(0.5, 5.0));

}  // namespace
}  // namespace omentum::physics
