#include "physics/intestine/gut_collisions.h"

#include "physics/intestine/active_pairs.h"
#include "tests/physics/intestine/restless_gut.h"
#include "tests/support/effort.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <set>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

constexpr double kStep_s = 0.002;

std::vector<double> even_masses(const geometry::GutShape& shape) {
  return std::vector<double>(shape.positions.size(), 0.01);
}

// Pairs by segment and part.
std::set<std::pair<std::int32_t, std::int32_t>> found(const GutCollisions& collisions) {
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const NearPair& pair : collisions.near_pairs()) pairs.insert({pair.segment, pair.part});
  return pairs;
}

TEST(GutCollisions, CompleteMethodMissesNothingInAnyStep) {
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  const GutParts& parts = collisions.parts();
  GutState state = test::state_of(shape);
  std::mt19937_64 random(5);
  std::size_t overlaps = 0;
  for (int step = 0; step < 150; ++step) {
    const std::vector<Vec3> before = state.x;
    const geometry::GutOverlaps all = geometry::all_overlaps(parts.layout, before, parts.reach, parts.near);
    test::shake(parts.layout, 0.3, kStep_s, random, state);
    collisions.resolve(before, state, {}, {});
    const auto pairs = found(collisions);
    for (const auto& tube : all.tube) EXPECT_TRUE(pairs.contains({tube.segment, tube.other}));
    for (const auto& sheet : all.mesentery)
      EXPECT_TRUE(pairs.contains({sheet.segment, sheet.other + parts.layout.segment_count()}));
    overlaps += all.tube.size() + all.mesentery.size();
  }
  EXPECT_GT(overlaps, 1000U);
}

class GutSearch : public ::testing::TestWithParam<GutPairMethod> {};

TEST_P(GutSearch, TakesNothingFromTheHeapAndIsTheSameInEveryRun) {
  const geometry::GutShape shape = test::folded_gut();
  const auto run = [&] {
    GutCollisions collisions(shape, even_masses(shape), kStep_s, {.method = GetParam()});
    GutState state = test::state_of(shape);
    std::mt19937_64 random(6);
    std::vector<Vec3> before;
    before.reserve(state.x.size());
    const GutObstacle floor{.centre = Vec3(0, 0, -0.3)};
    const MovingSphere ball{Vec3(0.3, 0, 0), Vec3(0.25, 0, 0), 0.005};
    std::size_t taken = 0;
    for (int step = 0; step < 60; ++step) {
      before.assign(state.x.begin(), state.x.end());
      test::shake(shape.layout, 0.5, kStep_s, random, state);
      const std::size_t heap = test::heap_allocations();
      collisions.resolve(before, state, std::span(&floor, 1), std::span(&ball, 1));
      taken += test::heap_allocations() - heap;
    }
    EXPECT_EQ(taken, 0U);
    return state;
  };
  const GutState one = run(), other = run();
  EXPECT_EQ(one.x, other.x);
  EXPECT_EQ(one.v, other.v);
}

INSTANTIATE_TEST_SUITE_P(Methods, GutSearch,
                         ::testing::Values(GutPairMethod::kComplete, GutPairMethod::kStochastic));

// A gut that shivers where it lies, folded more narrowly than its tube is wide.
TEST(GutCollisions, StochasticSearchFindsNearlyAllWithAFewTests) {
  geometry::GutShape shape = test::folded_gut();
  shape.tube_radius_m = 0.024;
  shape.mesentery_thickness_m = 0.012;
  const GutParts parts(shape);
  ActivePairs search(parts, 32, 1);
  NearPairs near;
  near.pairs.reserve(search.most_pairs());
  near.gap.resize(shape.positions.size());
  const std::vector<double> ways(shape.positions.size(), 0.001);
  std::mt19937_64 random(9);
  std::size_t there = 0, known = 0;
  std::int64_t tests = 0, pairs = 0;
  constexpr int kFinding = 200, kCounted = test::tried(100);
  for (int step = 0; step < kFinding + kCounted; ++step) {
    std::vector<Vec3> x = shape.positions;
    for (Vec3& p : x) p += test::random_vector(random, 0.001);
    search.find(x, ways, 0, near);
    if (step < kFinding) continue;
    tests += search.distance_tests();
    pairs += geometry::exhaustive_tests(parts.layout, parts.near);
    const geometry::GutOverlaps all = geometry::all_overlaps(parts.layout, x, parts.reach, parts.near);
    std::set<std::pair<std::int32_t, std::int32_t>> names;
    for (const NearPair& pair : near.pairs) names.insert({pair.segment, pair.part});
    for (const auto& tube : all.tube) known += names.count({tube.segment, tube.other});
    for (const auto& sheet : all.mesentery)
      known += names.count({sheet.segment, sheet.other + parts.layout.segment_count()});
    there += all.tube.size() + all.mesentery.size();
  }
  EXPECT_GT(there, test::tried(1000U));
  EXPECT_GE(static_cast<double>(known), 0.99 * static_cast<double>(there));
  EXPECT_LE(static_cast<double>(tests), 0.05 * static_cast<double>(pairs));
}

TEST(GutCollisions, WhatIsNotFiniteGoesNoFartherThanItMay) {
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  GutState state = test::state_of(shape);
  state.x[shape.layout.mass(0, 40)].x() = std::nan("");
  state.v[shape.layout.mass(0, 60)].y() = std::numeric_limits<double>::infinity();
  collisions.resolve(shape.positions, state, {}, {});
  for (const Vec3& x : state.x) EXPECT_TRUE(x.allFinite());
  for (const Vec3& v : state.v) EXPECT_TRUE(v.allFinite());
  const MassId lost = shape.layout.mass(0, 40);
  EXPECT_LT((state.x[lost] - shape.positions[lost]).norm(), collisions.parts().reach.tube_m);
}

// Every mass wants far into the corner of a box in which the gut just lies.
TEST(GutCollisions, TheCornerOfABoxHoldsWithBothItsWalls) {
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s, {.passes = 40});
  GutObstacle box{.kind = GutObstacle::Kind::kInsideBox};
  for (const Vec3& p : shape.positions)
    box.half_axes_m = box.half_axes_m.cwiseMax(p.cwiseAbs() + Vec3::Constant(shape.tube_radius_m));
  GutState state = test::state_of(shape);
  for (int step = 0; step < 60; ++step) {
    const std::vector<Vec3> before = state.x;
    for (std::size_t m = 0; m < state.x.size(); ++m) {
      if (!shape.layout.is_held(MassId(m))) state.x[m] += Vec3::Constant(0.004);
    }
    collisions.resolve(before, state, std::span(&box, 1), {});
  }
  double deepest = 0;
  for (std::int32_t c = 1; c < shape.layout.columns - 1; ++c) {
    const auto faces = faces_within(box, state.x[static_cast<std::size_t>(c)], 1);
    for (const WallPlace& wall : faces.near())
      deepest = std::max(deepest, shape.tube_radius_m - wall.depth_m);
  }
  EXPECT_LT(deepest, 0.05 * shape.tube_radius_m);
}

// Before and behind the springs and behind the contacts: it is still one mass that was held back.
TEST(GutCollisions, AMassThatTheBoundHoldsCountsOnceAStep) {
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  GutState state = test::state_of(shape);
  const std::vector<Vec3> before = state.x;
  for (std::size_t m = 0; m < state.x.size(); ++m)
    if (!shape.layout.is_held(MassId(m))) state.x[m].z() += 0.5;
  collisions.resolve(before, state, {}, {});
  EXPECT_EQ(collisions.report().bound_acted, (shape.layout.rows - 1) * (shape.layout.columns - 2));
}

TEST(GutCollisions, SpheresThatFindNoRoomAreTold) {
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s, {.most_spheres = 2});
  GutState state = test::state_of(shape);
  const std::vector<MovingSphere> spheres(5, MovingSphere{.radius_m = 0.001});
  collisions.resolve(shape.positions, state, {}, spheres);
  EXPECT_EQ(collisions.report().left_out, 3);
  EXPECT_EQ(collisions.outcomes().size(), 2U);
}

// Walls come last and keep their room when all masses meet many.
TEST(GutCollisions, ContactsThatFindNoRoomAreTold) {
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  GutState state = test::state_of(shape);
  const GutObstacle floor{.centre = Vec3(0, 0, 1)};
  const std::vector<GutObstacle> few(4, floor), many(400, floor);
  collisions.resolve(shape.positions, state, few, {});
  EXPECT_EQ(collisions.report().left_out, 0);
  collisions.resolve(shape.positions, state, many, {});
  EXPECT_GT(collisions.report().left_out, 0);
}

// A correction is no step: a mass that the bound stops keeps the velocity that its step gave it.
TEST(GutCollisions, ABoundCorrectionLeavesTheVelocityOfTheStep) {
  const geometry::GutShape shape = test::folded_gut();
  GutCollisions collisions(shape, even_masses(shape), kStep_s);
  GutState state = test::state_of(shape);
  const MassId far = shape.layout.mass(0, 40);
  const std::vector<Vec3> carried(state.x.size(), Vec3(0, 0, 0.01));
  state.v = carried;
  state.x[far].z() += 1;
  collisions.resolve(shape.positions, state, {}, {}, nullptr, carried);
  const Vec3 way = state.x[far] - shape.positions[far];
  EXPECT_LT(way.norm(), 0.02);
  EXPECT_LT((state.v[far] - carried[far] - way / kStep_s).norm(), 1e-9);
}

TEST(GutCollisions, SaysWhatIsExpected) {
  const geometry::GutShape shape = test::folded_gut();
  const std::vector<double> masses = even_masses(shape);
  EXPECT_THROW(GutCollisions(shape, std::span(masses).first(3), kStep_s), std::invalid_argument);
  EXPECT_THROW(GutCollisions(shape, std::vector<double>(masses.size(), 0.0), kStep_s), std::invalid_argument);
  EXPECT_THROW(GutCollisions(shape, masses, 0), std::invalid_argument);
  EXPECT_THROW(GutCollisions(shape, masses, kStep_s, {.passes = 0}), std::invalid_argument);
  EXPECT_THROW(GutCollisions(shape, masses, kStep_s, {.friction = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace omentum::physics
