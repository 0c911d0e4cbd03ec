#include "geometry/segment_points.h"

#include "geometry/closest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace omentum::geometry {
namespace {

constexpr double kRounding = 1e-12;  // of squares of lengths about 1

class SegmentPointsTest : public testing::Test {
 protected:
  Vec3 random_point() {
    std::uniform_real_distribution<double> unit(-1, 1);
    return {unit(random_), unit(random_), unit(random_)};
  }
  std::mt19937 random_{11};
};

Vec3 along(const Vec3& p, const Vec3& q, double s) {
  return p + s * (q - p);
}

Vec3 inside(const Vec3& k, const Vec3& a, const Vec3& b, const Vec3& c) {
  return k[0] * a + k[1] * b + k[2] * c;
}

// Of two segments, by points on the first and what is nearest to them on the second: never below the truth.
double sampled_distance(const Vec3& p1, const Vec3& q1, const Vec3& p2, const Vec3& q2) {
  double least = 1e300;
  for (int i = 0; i <= 200; ++i) {
    const Vec3 on_first = along(p1, q1, i / 200.0), way = q2 - p2;
    const double squared = way.squaredNorm();
    const double t = squared > 0 ? std::clamp((on_first - p2).dot(way) / squared, 0.0, 1.0) : 0;
    least = std::min(least, (on_first - along(p2, q2, t)).squaredNorm());
  }
  return least;
}

void expect_nearest(const Vec3& p1, const Vec3& q1, const Vec3& p2, const Vec3& q2) {
  const SegmentPair pair = closest_points_of_segments(p1, q1, p2, q2);
  ASSERT_GE(pair.s, 0);
  ASSERT_LE(pair.s, 1);
  ASSERT_GE(pair.t, 0);
  ASSERT_LE(pair.t, 1);
  EXPECT_NEAR((along(p1, q1, pair.s) - along(p2, q2, pair.t)).squaredNorm(), pair.squared_distance,
              kRounding);
  EXPECT_LE(pair.squared_distance, sampled_distance(p1, q1, p2, q2) + kRounding);
  EXPECT_NEAR(closest_points_of_segments(p2, q2, p1, q1).squared_distance, pair.squared_distance, kRounding)
      << "the order does not matter";
}

TEST_F(SegmentPointsTest, NoPointsOfTwoSegmentsAreNearer) {
  for (int i = 0; i < 2000; ++i)
    expect_nearest(random_point(), random_point(), random_point(), random_point());
}

TEST_F(SegmentPointsTest, ParallelAndNearlyParallelSegmentsAreMeasuredAsWell) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random_point(), q = random_point(), beside = random_point();
    const double turned = std::pow(10, -i % 20);
    for (const double sense : {1.0, -1.0}) {
      const Vec3 way = sense * (q - p) + turned * random_point();
      expect_nearest(p, q, beside, beside + way);
      expect_nearest(p, q, p + 0.3 * (q - p), p + 0.3 * (q - p) + way);
    }
  }
}

TEST_F(SegmentPointsTest, ASegmentMayBeAPoint) {
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_point(), q = random_point(), r = random_point();
    expect_nearest(p, p, q, r);
    expect_nearest(q, r, p, p);
    expect_nearest(p, p, q, q);
  }
}

TEST_F(SegmentPointsTest, CrossingSegmentsAreAtNoDistance) {
  for (int i = 0; i < 500; ++i) {
    const Vec3 middle = random_point(), a = random_point(), b = random_point();
    const SegmentPair pair =
        closest_points_of_segments(middle - a, middle + a, middle - 0.5 * b, middle + 1.5 * b);
    EXPECT_LT(pair.squared_distance, kRounding * kRounding);
    EXPECT_NEAR(pair.s, 0.5, 1e-9);
    EXPECT_NEAR(pair.t, 0.25, 1e-9);
  }
}

void expect_nearest_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const SegmentTrianglePair pair = closest_points_of_segment_and_triangle(p, q, a, b, c);
  ASSERT_GE(pair.s, 0);
  ASSERT_LE(pair.s, 1);
  ASSERT_NEAR(pair.barycentric.sum(), 1, kRounding);
  ASSERT_GE(pair.barycentric.minCoeff(), 0);
  EXPECT_NEAR((along(p, q, pair.s) - inside(pair.barycentric, a, b, c)).squaredNorm(), pair.squared_distance,
              kRounding);
  for (int i = 0; i <= 50; ++i) {
    const Vec3 on_segment = along(p, q, i / 50.0);
    EXPECT_LE(pair.squared_distance,
              closest_point_on_triangle(on_segment, a, b, c).squared_distance + kRounding);
  }
}

TEST_F(SegmentPointsTest, NoPointsOfSegmentAndTriangleAreNearer) {
  for (int i = 0; i < 2000; ++i)
    expect_nearest_triangle(random_point(), random_point(), random_point(), random_point(), random_point());
}

TEST_F(SegmentPointsTest, ATriangleMayLieInTheSegmentsPlaneOrHaveNoArea) {
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random_point(), b = random_point(), c = random_point(), k = random_point(),
               l = random_point();
    const Vec3 p = a + k[0] * (b - a) + k[1] * (c - a), q = a + l[0] * (b - a) + l[1] * (c - a);
    expect_nearest_triangle(p, q, a, b, c);
    expect_nearest_triangle(c, p + k, a, b, b);
    expect_nearest_triangle(p, q + k, a, a, a);
    expect_nearest_triangle(p, p, a, b, c);
  }
}

TEST_F(SegmentPointsTest, WhatPassesThroughATriangleIsAtNoDistance) {
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random_point(), b = random_point(), c = random_point();
    Vec3 k = random_point().cwiseAbs() + Vec3::Constant(0.01);
    k /= k.sum();
    const Vec3 normal = (b - a).cross(c - a), hit = inside(k, a, b, c);
    const SegmentTrianglePair pair =
        closest_points_of_segment_and_triangle(hit - normal, hit + normal, a, b, c);
    EXPECT_EQ(pair.squared_distance, 0);
    EXPECT_NEAR(pair.s, 0.5, 1e-9);
    EXPECT_LT((pair.barycentric - k).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace omentum::geometry
