#include "geometry/closest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace omentum::geometry {
namespace {

constexpr double kRounding = 1e-12;  // positions are about 1: a few hundred roundings

class ClosestPointsTest : public testing::Test {
 protected:
  Vec3 random_point() {
    std::uniform_real_distribution<double> unit(-1, 1);
    return {unit(random_), unit(random_), unit(random_)};
  }
  std::mt19937 random_{7};
};

Vec3 point_at(const Vec3& k, const Vec3& a, const Vec3& b, const Vec3& c) {
  return k[0] * a + k[1] * b + k[2] * c;
}

TEST_F(ClosestPointsTest, NoPointOfTheTriangleIsCloser) {
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_point(), a = random_point(), b = random_point(), c = random_point();
    const TrianglePoint found = closest_point_on_triangle(p, a, b, c);
    ASSERT_NEAR(found.barycentric.sum(), 1, kRounding);
    ASSERT_GE(found.barycentric.minCoeff(), 0);
    ASSERT_NEAR((point_at(found.barycentric, a, b, c) - p).squaredNorm(), found.squared_distance, kRounding);
    constexpr int kSteps = 20;
    for (int j = 0; j <= kSteps; ++j) {
      for (int k = 0; k + j <= kSteps; ++k) {
        const Vec3 sample = Vec3(j, k, kSteps - j - k) / kSteps;
        ASSERT_LE(found.squared_distance, (point_at(sample, a, b, c) - p).squaredNorm() + kRounding);
      }
    }
  }
}

TEST_F(ClosestPointsTest, APointOfTheTriangleIsItsOwnClosestPoint) {
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random_point(), b = random_point(), c = random_point();
    Vec3 k = random_point().cwiseAbs();
    k /= k.sum();
    EXPECT_LT(closest_point_on_triangle(point_at(k, a, b, c), a, b, c).squared_distance,
              kRounding * kRounding);
  }
}

TEST_F(ClosestPointsTest, ATriangleWithoutAreaIsItsLongestEdge) {
  const Vec3 p(0.3, 1, 0);
  const TrianglePoint on_line = closest_point_on_triangle(p, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  EXPECT_NEAR(on_line.squared_distance, 1, kRounding);
  const TrianglePoint on_point = closest_point_on_triangle(p, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(on_point.squared_distance, p.squaredNorm(), kRounding);
  EXPECT_NEAR(on_point.barycentric.sum(), 1, kRounding);
}

TEST_F(ClosestPointsTest, HitsWhereItWasAimedAt) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random_point(), b = random_point(), c = random_point(), p = 3 * random_point();
    Vec3 k = random_point().cwiseAbs() + Vec3::Constant(0.01);
    k /= k.sum();
    const Vec3 target = point_at(k, a, b, c);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    if (std::abs((target - p).normalized().dot(normal)) < 1e-3)
      continue;  // grazing: conditioned too badly to compare
    const double beyond = std::uniform_real_distribution<double>(1.1, 3)(random_);
    const auto hit = intersect_segment_triangle(p, p + beyond * (target - p), a, b, c);
    ASSERT_TRUE(hit);
    constexpr double kConditioned = 1e-8;  // rounding over the smallest angle and area let through
    EXPECT_NEAR(hit->parameter, 1 / beyond, kConditioned);
    EXPECT_LT((point_at(hit->barycentric, a, b, c) - target).norm(), kConditioned);
    EXPECT_FALSE(intersect_segment_triangle(p, p + 0.9 * (target - p), a, b, c)) << "too short to reach";
  }
}

TEST_F(ClosestPointsTest, BothDirectionsAndBothOrientationsHit) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), above(0.2, 0.3, 1), below(0.2, 0.3, -1);
  EXPECT_TRUE(intersect_segment_triangle(above, below, a, b, c));
  EXPECT_TRUE(intersect_segment_triangle(below, above, a, b, c));
  EXPECT_TRUE(intersect_segment_triangle(above, below, a, c, b));
}

TEST_F(ClosestPointsTest, CoplanarAndEmptySegmentsHitNothing) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_FALSE(intersect_segment_triangle({-1, 0.2, 0}, {2, 0.2, 0}, a, b, c));
  EXPECT_FALSE(intersect_segment_triangle({0.2, 0.2, 0}, {0.2, 0.2, 0}, a, b, c));
  EXPECT_FALSE(intersect_segment_triangle({0.2, 0.2, 1}, {0.2, 0.2, -1}, a, a, b));
}

// A fan of triangles around a vertex, as on a surface: seen along the segments of these tests it covers its
// neighbourhood once, so each segment through it must hit at least one.
class FanTest : public ClosestPointsTest {
 protected:
  void make_fan() {
    constexpr int kBlades = 7;
    centre_ = random_point();
    rim_.clear();
    for (int i = 0; i < kBlades; ++i) {
      const double angle = 6.283185307179586 * (i + 0.3 * random_point().x()) / kBlades;
      rim_.push_back(centre_ + Vec3(std::cos(angle), std::sin(angle), 0.3 * random_point().z()));
    }
  }
  int hits(const Vec3& p, const Vec3& q) const {
    int count = 0;
    for (std::size_t i = 0; i < rim_.size(); ++i) {
      // the stored order of corners differs between neighbours, as it does on any surface
      const Vec3 &next = rim_[(i + 1) % rim_.size()], &rim = rim_[i];
      const bool hit = i % 3 == 0   ? intersect_segment_triangle(p, q, centre_, rim, next).has_value()
                       : i % 3 == 1 ? intersect_segment_triangle(p, q, rim, next, centre_).has_value()
                                    : intersect_segment_triangle(p, q, next, centre_, rim).has_value();
      count += hit;
    }
    return count;
  }
  // Steep, so that the fan is seen as a disk.
  Vec3 steep_direction() { return Vec3(0.2 * random_point().x(), 0.2 * random_point().y(), 1); }

  Vec3 centre_;
  std::vector<Vec3> rim_;
};

TEST_F(FanTest, SegmentsThroughTheSharedVertexHit) {
  for (int i = 0; i < 20000; ++i) {
    make_fan();
    const Vec3 d = steep_direction();
    ASSERT_GE(hits(centre_ - d, centre_ + d), 1) << i;
    ASSERT_GE(hits(centre_ + d, centre_ - 0.37 * d), 1) << i;
  }
}

TEST_F(FanTest, SegmentsThroughSharedEdgesHit) {
  for (int i = 0; i < 20000; ++i) {
    make_fan();
    const Vec3 d = steep_direction();
    const double along = std::uniform_real_distribution<double>(0, 0.9)(random_);
    const Vec3 target = centre_ + along * (rim_[static_cast<std::size_t>(i) % rim_.size()] - centre_);
    ASSERT_GE(hits(target - d, target + d), 1) << i;
  }
}

TEST_F(FanTest, VerticalSegmentsThroughExactCoordinatesHit) {
  // along an axis the projection is exact: points on edges and vertices give areas of exactly zero
  centre_ = Vec3::Zero();
  rim_ = {{1, 0, 0.5},  {1, 1, 0},   {0, 1, 0.25},  {-1, 1, 0},
          {-1, 0, 0.5}, {-1, -1, 0}, {0, -1, 0.75}, {1, -1, 0}};
  for (const double s : {0.0, 0.25, 0.5, 1.0}) {
    for (const Vec3& rim : rim_) {
      const Vec3 target = s * rim;
      EXPECT_GE(hits(target - Vec3::UnitZ() * 4, target + Vec3::UnitZ() * 4), 1);
    }
  }
}

TEST_F(FanTest, ConsecutiveSegmentsThatMeetOnTheSurfaceDoNotSlipThrough) {
  for (int i = 0; i < 20000; ++i) {
    make_fan();
    const Vec3 d = steep_direction();
    const std::size_t blade = static_cast<std::size_t>(i) % rim_.size();
    const Vec3 on_surface = (centre_ + rim_[blade] + rim_[(blade + 1) % rim_.size()]) / 3;
    ASSERT_GE(hits(on_surface - d, on_surface) + hits(on_surface, on_surface + d), 1) << i;
  }
}

}  // namespace
}  // namespace omentum::geometry
