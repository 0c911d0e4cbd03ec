#include "geometry/tube_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace omentum::geometry {
namespace {

constexpr double kSplitRounding = 1e-12;

std::vector<Vec3> line_of(int masses) {
  std::vector<Vec3> axis;
  for (int i = 0; i < masses; ++i) axis.emplace_back(0.04 * i, 0, 0);
  return axis;
}

/// A right angle at mass 4.
std::vector<Vec3> corner_axis() {
  std::vector<Vec3> axis = line_of(9);
  for (std::size_t i = 5; i < axis.size(); ++i)
    axis[i] = axis[4] + 0.04 * Vec3(0, static_cast<double>(i) - 4, 0);
  return axis;
}

std::vector<Vec3> random_axis(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> turn(0, 0.7);
  std::vector<Vec3> axis{Vec3::Zero()};
  Vec3 way(0.04, 0, 0);
  for (int i = 1; i < 60; ++i) {
    way = (way + 0.04 * Vec3(turn(random), turn(random), turn(random))).normalized() * 0.04;
    axis.push_back(axis.back() + way);
  }
  return axis;
}

struct Split {
  Split(const std::vector<Vec3>& masses, double eps) : axis(masses.size()), split(masses.size()) {
    axis.set(masses);
    split.split(axis, eps);
  }
  bool has(double u) const {
    return std::ranges::any_of(split.cuts(), [&](double cut) { return std::abs(cut - u) < kSplitRounding; });
  }
  TubeAxis axis;
  TubeSplit split;
};

double curvature(const AxisCubic& segment, double t) {
  const Vec3 slope = segment.b + t * (2 * segment.c + 3 * t * segment.d);
  return slope.cross(2 * segment.c + 6 * t * segment.d).norm() / std::pow(slope.norm(), 3);
}

TEST(TubeAxisTurn, IsHalfOfOneLessTheCosine) {
  const Vec3 from(-0.04, 0, 0), at(0, 0, 0);
  const auto turn = [&](const Vec3& to) {
    TubeAxis axis(3);
    axis.set(std::vector<Vec3>{from, at, to});
    return axis.turn_at(1);
  };
  EXPECT_NEAR(turn({0.1, 0, 0}), 0, kSplitRounding) << "straight on";
  EXPECT_NEAR(turn({0, 0.07, 0}), 0.5, kSplitRounding) << "a right angle";
  EXPECT_NEAR(turn({-0.02, 0, 0}), 1, kSplitRounding) << "straight back";
  EXPECT_EQ(turn(at), 0) << "no direction";
}

TEST(TubeAxisTurn, OfTheFirstMassIsTheParabolasThroughTheFirstThree) {
  TubeAxis axis(4);
  axis.set(line_of(4));
  EXPECT_NEAR(axis.turn_at(0), 0, kSplitRounding);
  std::vector<Vec3> bent = line_of(4);
  bent[2].y() = bent[3].y() = 0.02;
  axis.set(bent);
  const Vec3 in = bent[0] - ghost_before(bent[0], bent[1], bent[2]), out = bent[1] - bent[0];
  EXPECT_NEAR(axis.turn_at(0), 0.5 * (1 - in.normalized().dot(out.normalized())), kSplitRounding);
}

TEST(TubeAxisCubic, IsTheSplineOfItsSegment) {
  TubeAxis axis(60);
  axis.set(random_axis(3));
  for (std::size_t i = 0; i < 59; ++i) {
    const AxisCubic c = axis.cubic(i);
    for (const double t : {0.0, 0.3, 1.0})
      EXPECT_LT((c.a + t * (c.b + t * (c.c + t * c.d)) - axis.at(static_cast<double>(i) + t).place).norm(),
                kSplitRounding);
  }
}

TEST(TubeSplit, AStraightTubeHasAPieceForEachSegment) {
  const Split straight(line_of(8), 1e-6);
  ASSERT_EQ(straight.split.cuts().size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(straight.split.cuts()[i], static_cast<double>(i));
}

TEST(TubeSplit, APieceGoesOverAFoldedMassThatHasNoFrame) {
  const Split corner(corner_axis(), 0.3);
  EXPECT_FALSE(corner.has(4));
  EXPECT_TRUE(corner.has(4 - 1.0 / 3));
  EXPECT_TRUE(corner.has(4 + 1.0 / 3));
  EXPECT_TRUE(corner.has(3) && corner.has(5)) << "their neighbours are straight";
}

TEST(TubeSplit, TurnsBelowTheThresholdAreNotCut) {
  EXPECT_EQ(Split(corner_axis(), 0.51).split.cuts().size(), 9u);
  EXPECT_GT(Split(corner_axis(), 0.49).split.cuts().size(), 9u);
}

TEST(TubeSplit, NoFrameStandsWhereASegmentIsCurvedMost) {
  constexpr int kFine = 400;
  int folded = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Split random(random_axis(seed), 0.05);
    const std::span<const double> turns = random.split.turns();
    for (std::size_t i = 1; i + 2 < turns.size(); ++i) {  // a cap's frame stays
      if (turns[i] < 0.05 && turns[i + 1] < 0.05) continue;
      const AxisCubic segment = random.axis.cubic(i);
      double most = 0, at = 0;
      for (int f = 0; f <= kFine; ++f) {
        const double t = static_cast<double>(f) / kFine, here = curvature(segment, t);
        if (here > most) most = here, at = t;
      }
      for (const double cut : random.split.cuts())
        EXPECT_GT(std::abs(cut - static_cast<double>(i) - at), 1e-3) << "seed " << seed << " segment " << i;
      ++folded;
    }
  }
  EXPECT_GT(folded, 200);
}

TEST(TubeSplit, AFinerThresholdCutsMore) {
  std::size_t before = 0;
  for (const double eps : {1.1, 0.3, 0.1, 0.03, 0.01}) {
    const Split random(random_axis(7), eps);
    EXPECT_GE(random.split.cuts().size(), before);
    before = random.split.cuts().size();
    EXPECT_TRUE(std::ranges::is_sorted(random.split.cuts(), std::less_equal{}));
    EXPECT_EQ(random.split.cuts().front(), 0);
    EXPECT_EQ(random.split.cuts().back(), random.axis.end());
  }
  EXPECT_GT(before, Split(random_axis(7), 1.1).split.cuts().size());
}

TEST(TubeSplit, WhoWantsFramesOnAStraightSegmentGetsThirds) {
  TubeAxis axis(5);
  axis.set(line_of(5));
  TubeSplit split(5);
  split.split(axis, 0.03, std::vector<std::uint8_t>{0, 0, 1, 0});
  const std::vector<double> wanted{0, 1, 2, 2 + 1.0 / 3, 2 + 2.0 / 3, 3, 4};
  ASSERT_EQ(split.cuts().size(), wanted.size());
  for (std::size_t c = 0; c < wanted.size(); ++c) EXPECT_NEAR(split.cuts()[c], wanted[c], kSplitRounding);
}

}  // namespace
}  // namespace omentum::geometry
