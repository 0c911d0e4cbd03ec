// Where a gut touches itself, as it is told to who looks.
#include "physics/intestine/gut_system.h"

#include "tests/physics/intestine/restless_gut.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

std::vector<Touch> touches_of(const GutSystem& gut, std::size_t room = 2000) {
  std::vector<Touch> touches(room);
  touches.resize(gut.touches(touches));
  return touches;
}

// Of a point from a segment of the axis, m.
double off_segment(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double share = std::clamp((point - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (point - from - share * way).norm();
}

// Of a point from a triangle that it lies in the plane of, or beside, m: how much larger the triangles with
// its corners are than it is, over its longest edge.
double off_triangle(const Vec3& point, const std::array<Vec3, 3>& corner) {
  const auto doubled = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a).norm();
  };
  const double own = doubled(corner[0], corner[1], corner[2]);
  double around = 0, longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    around += doubled(point, corner[i], corner[(i + 1) % 3]);
    longest = std::max(longest, (corner[i] - corner[(i + 1) % 3]).norm());
  }
  return (around - own) / longest;
}

/// What lies on a plane for a while, and the pairs of its parts that a search without any cleverness finds.
class GutTouches : public testing::Test {
 protected:
  void lie(int steps) {
    for (int step = 0; step < steps; ++step) gut_.step({.obstacles = std::span(&floor_, 1)});
  }
  const std::vector<Vec3>& x() const { return gut_.state().x; }
  bool is_on(const Vec3& point, std::int32_t part) const {
    constexpr double kOn_m = 1e-6;
    const std::array<MassId, 3>& m = parts_.masses[static_cast<std::size_t>(part)];
    if (parts_.is_segment(part)) return off_segment(point, x()[m[0]], x()[m[1]]) < kOn_m;
    return off_triangle(point, {x()[m[0]], x()[m[1]], x()[m[2]]}) < kOn_m;
  }

  const geometry::GutShape shape_ = test::folded_gut();
  const GutParts parts_{shape_};
  const GutObstacle floor_{.centre = Vec3(0, 0, -0.1)};
  GutSystem gut_{shape_, GutMaterial{}, {}, {.step_s = 0.005}};
};

TEST_F(GutTouches, AreContactsThatEveryPairOfPartsIsTriedFor) {
  lie(300);
  const double watched_m = GutCollisions::kWatched * parts_.least_reach_m();
  const std::vector<Touch> touches = touches_of(gut_);
  EXPECT_GT(touches.size(), 20U);
  const geometry::GutOverlaps near = geometry::all_overlaps(
      parts_.layout, x(), {parts_.reach.tube_m + watched_m, parts_.reach.mesentery_m + watched_m},
      parts_.near);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& tube : near.tube) pairs.emplace_back(tube.segment, tube.other);
  for (const auto& sheet : near.mesentery)
    pairs.emplace_back(sheet.segment, sheet.other + parts_.layout.segment_count());
  for (const Touch& touch : touches) {
    EXPECT_GT(touch.overlap_m(), -watched_m) << "farther apart than what a pass may close";
    EXPECT_GE(touch.push_n, 0);
    EXPECT_TRUE(touch.push_n > 0 || touch.overlap_m() > 0);
    EXPECT_TRUE(std::ranges::any_of(pairs,
                                    [&](const auto& pair) {
                                      const double reach_m = parts_.reach_m(pair.second);
                                      return std::abs(touch.radius_one_m + touch.radius_other_m - reach_m) <
                                                 1e-12 &&
                                             is_on(touch.one, pair.first) && is_on(touch.other, pair.second);
                                    }))
        << "between " << touch.one.transpose() << " and " << touch.other.transpose();
  }
}

// A wall holds one of its masses, and is no part of the gut.
TEST_F(GutTouches, LeaveOutWallsAndWhatFindsNoRoom) {
  lie(300);
  const auto all = touches_of(gut_);
  EXPECT_LT(all.size(), static_cast<std::size_t>(gut_.report().collisions.contacts))
      << "the floor's are among those";
  EXPECT_EQ(touches_of(gut_, 7).size(), 7U);
  std::vector<Touch> room(2000);
  const std::size_t heap = test::heap_allocations();
  gut_.touches(room);
  EXPECT_EQ(test::heap_allocations(), heap);
  gut_.reset();
  EXPECT_TRUE(touches_of(gut_).empty()) << "at rest as it was made";
}

/// Two legs that cross each other at right angles, a third of their reach too near, each with its mesentery
/// away from the other one.
geometry::GutShape crossing_legs() {
  constexpr std::int32_t kColumns = 40, kRows = 2, kLeg = kColumns / 2;
  geometry::GutShape shape{{kRows, kColumns}, {}, 0.012, 0.004};
  shape.positions.resize(static_cast<std::size_t>(kColumns * kRows));
  for (std::int32_t m = 0; m < shape.layout.mass_count(); ++m) {
    const std::int32_t column = shape.layout.column(MassId(m)), row = shape.layout.row(MassId(m));
    const bool upper = column >= kLeg;
    const double along = 0.02 * (upper ? column - kLeg : column) - 0.2;
    const double height = (upper ? 0.008 : -0.008) * (row == 0 ? 1 : 8);
    shape.positions[static_cast<std::size_t>(m)] = upper ? Vec3(0, along, height) : Vec3(along, 0, height);
  }
  return shape;
}

// Newton's third law, by what the masses of either leg got.
TEST(GutTouchForces, AreTheMomentumThatEachSideGetsInAStep) {
  constexpr double kLegStep_s = 0.005, kMass_kg = 0.01;
  const geometry::GutShape shape = crossing_legs();
  GutCollisions collisions(shape, std::vector<double>(shape.positions.size(), kMass_kg), kLegStep_s,
                           {.friction = 0});
  GutState state = test::state_of(shape);
  const auto is_upper = [&](std::size_t m) {
    return shape.layout.column(MassId(m)) >= shape.layout.columns / 2;
  };
  for (std::size_t m = 0; m < state.x.size(); ++m) {
    if (shape.layout.is_held(MassId(m))) continue;
    state.v[m] = Vec3(0, 0, is_upper(m) ? -0.1 : 0.1);
    state.x[m] += kLegStep_s * state.v[m];
  }
  const GutState wanted = state;
  collisions.resolve(shape.positions, state, {}, {});
  ASSERT_EQ(collisions.report().bound_acted, 0) << "the bound gives no momentum back";
  Vec3 upper = Vec3::Zero(), lower = Vec3::Zero();
  for (std::size_t m = 0; m < state.x.size(); ++m)
    (is_upper(m) ? upper : lower) += kMass_kg * (state.v[m] - wanted.v[m]);
  std::vector<Touch> touches(100);
  touches.resize(collisions.touches(state.x, touches));
  Vec3 on_upper = Vec3::Zero();
  for (const Touch& touch : touches) {
    const Vec3 on_one = touch.push_n * (touch.one - touch.other).normalized();
    on_upper += touch.one.z() > touch.other.z() ? on_one : Vec3(-on_one);
  }
  EXPECT_GT(on_upper.z(), 0.1);
  EXPECT_LT((kLegStep_s * on_upper - upper).norm(), 1e-9);
  EXPECT_LT((upper + lower).norm(), 1e-12);
}

}  // namespace
}  // namespace omentum::physics
