#include "geometry/bucket_grid.h"

#include "geometry/closest_points.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace omentum::geometry {
namespace {

// A real liver when its file is there, else a finely cut box; millimetres to metres.
TetraMesh some_organ() {
  const std::filesystem::path file = test::data_file("tet/openhelp_liver_7k.msh");
  if (std::filesystem::exists(file)) return check_mesh(read_mesh(file), 1e-3).mesh;
  return test::make_box_mesh(12, 10, 8, {0.18, 0.15, 0.12});
}

class BucketGridTest : public testing::Test {
 protected:
  BucketGridTest()
      : mesh_(some_organ()),
        surface_(extract_surface(mesh_, {})),
        rest_(surface_positions(mesh_, surface_)),
        now_(rest_),
        grid_(surface_, rest_, BucketGrid::suitable_slack(surface_, rest_)) {
    low_ = high_ = rest_[0];
    for (const Vec3& p : rest_) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
  }

  Vec3 random_point(double margin_m) {
    std::uniform_real_distribution<double> unit(0, 1);
    const Vec3 size = high_ - low_ + Vec3::Constant(2 * margin_m);
    return low_ - Vec3::Constant(margin_m) +
           size.cwiseProduct(Vec3(unit(random_), unit(random_), unit(random_)));
  }

  // A dent of 4 cm and a wave over all: triangles turn, stretch and leave their boxes.
  void deform(double phase) {
    const Vec3 pressed = rest_[0];
    for (std::size_t s = 0; s < rest_.size(); ++s) {
      const double r = (rest_[s] - pressed).norm();
      now_[s] = rest_[s] - 0.04 * std::exp(-r * r / (0.05 * 0.05)) * Vec3::UnitZ() +
                0.01 * Vec3(std::sin(40 * rest_[s].y() + phase), std::cos(30 * rest_[s].z() + phase),
                            std::sin(phase));
    }
  }

  void update_all() {
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) grid_.update(TriangleId(t), now_);
  }

  // Brute force, after a look at the bounding boxes that only saves time.
  bool hits(const Triangle& t, const Vec3& p, const Vec3& q) const {
    const Vec3 &a = now_[t[0]], &b = now_[t[1]], &c = now_[t[2]];
    const auto apart = [&](int i) {
      return std::max(p[i], q[i]) < std::min({a[i], b[i], c[i]}) ||
             std::min(p[i], q[i]) > std::max({a[i], b[i], c[i]});
    };
    return !apart(0) && !apart(1) && !apart(2) && intersect_segment_triangle(p, q, a, b, c).has_value();
  }

  // Every triangle that the segment hits must be visited, and none twice. Returns the number of hits.
  int expect_no_miss(const Vec3& p, const Vec3& q, double radius_m) {
    std::vector<int> visits(surface_.triangles.size(), 0);
    grid_.visit_segment(p, q, radius_m, [&](TriangleId t) { ++visits[t]; });
    int count = 0;
    for (std::size_t t = 0; t < visits.size(); ++t) {
      if (visits[t] > 1) ADD_FAILURE() << "triangle " << t << " visited " << visits[t] << " times";
      if (!hits(surface_.triangles[t], p, q)) continue;
      ++count;
      if (visits[t] == 0) ADD_FAILURE() << "triangle " << t << " missed";
    }
    return count;
  }

  double brute_force_distance(const Vec3& p) const {
    double squared = std::numeric_limits<double>::infinity();
    for (const Triangle& t : surface_.triangles) {
      squared = std::min(squared,
                         closest_point_on_triangle(p, now_[t[0]], now_[t[1]], now_[t[2]]).squared_distance);
    }
    return std::sqrt(squared);
  }

  TetraMesh mesh_;
  Surface surface_;
  std::vector<Vec3> rest_, now_;
  BucketGrid grid_;
  Vec3 low_, high_;
  std::mt19937 random_{20240101};
};

TEST_F(BucketGridTest, HundredThousandFastSegmentsMissNoTriangleOfTheDeformedSurface) {
  deform(1.0);
  update_all();
  constexpr int kSegments = test::tried(100'000);
  int hits = 0;
  for (int i = 0; i < kSegments && !HasFailure(); ++i) {
    const Vec3 p = random_point(0.03);
    // from a millimetre to through the whole organ in one tick
    const double length = std::pow(10.0, std::uniform_real_distribution<double>(-3, -0.3)(random_));
    hits += expect_no_miss(p, p + length * (random_point(0.03) - p).normalized(), 0);
  }
  EXPECT_GT(hits, kSegments / 4);
}

TEST_F(BucketGridTest, SegmentsAlongTheAxesMissNoTriangle) {
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point(0.01);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 q = p;
      q[axis] += i % 2 ? 0.5 : -0.5;
      expect_no_miss(p, q, 0);
    }
  }
}

TEST_F(BucketGridTest, FindsTrianglesWithinTheRadiusOfASegment) {
  deform(2.0);
  update_all();
  constexpr double kRadius = 0.006;
  for (int i = 0; i < test::tried(2000); ++i) {
    const Vec3 p = random_point(0.02), q = p + 0.02 * (random_point(0.02) - p).normalized();
    std::vector<bool> visited(surface_.triangles.size(), false);
    grid_.visit_segment(p, q, kRadius, [&](TriangleId t) { visited[t] = true; });
    const Vec3 middle = 0.5 * (p + q);
    for (std::size_t t = 0; t < visited.size(); ++t) {
      const Triangle& v = surface_.triangles[t];
      const auto near = closest_point_on_triangle(middle, now_[v[0]], now_[v[1]], now_[v[2]]);
      if (near.squared_distance < kRadius * kRadius) {
        ASSERT_TRUE(visited[t]);
      }
    }
  }
}

TEST_F(BucketGridTest, ManyUpdatesLeaveNoStaleBucket) {
  for (int step = 0; step < 60; ++step) {
    deform(0.2 * step);
    update_all();
    for (int i = 0; i < 20; ++i) expect_no_miss(random_point(0.03), random_point(0.03), 0);
  }
  now_ = rest_;
  update_all();
  for (int i = 0; i < 500; ++i) expect_no_miss(random_point(0.03), random_point(0.03), 0);
}

TEST_F(BucketGridTest, FollowsASurfaceThatTravelsFar) {
  for (const double distance : {0.5, -20.0, 300.0, 0.0}) {
    for (std::size_t s = 0; s < rest_.size(); ++s)
      now_[s] = rest_[s] + Vec3(distance, -distance, 2 * distance);
    update_all();
    const Vec3 offset = now_[0] - rest_[0];
    int hits = 0;
    for (int i = 0; i < 300; ++i)
      hits += expect_no_miss(random_point(0.02) + offset, random_point(0.02) + offset, 0);
    EXPECT_GT(hits, 0);
  }
}

TEST_F(BucketGridTest, TrianglesStretchedBeyondTheirEntriesAreStillFoundAndComeBack) {
  for (std::size_t s = 0; s < rest_.size(); ++s) now_[s] = 4.0 * rest_[s];
  update_all();
  EXPECT_GT(grid_.overflow_count(), 0);
  int hits = 0;
  for (int i = 0; i < 500; ++i) hits += expect_no_miss(4.0 * random_point(0.0), 4.0 * random_point(0.0), 0);
  EXPECT_GT(hits, 0);
  now_ = rest_;
  update_all();
  EXPECT_EQ(grid_.overflow_count(), 0);
  for (int i = 0; i < 200; ++i) expect_no_miss(random_point(0.02), random_point(0.02), 0);
}

TEST_F(BucketGridTest, TurningAndStretchingWithinBoundsNeedsNoOverflow) {
  for (int step = 0; step < 50; ++step) {
    const Vec3 axis = random_point(0).normalized();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.13 * step, axis).toRotationMatrix() * 0.999 * BucketGrid::kStretch;
    for (std::size_t s = 0; s < rest_.size(); ++s) now_[s] = turn * rest_[s];
    update_all();
    EXPECT_EQ(grid_.overflow_count(), 0);
  }
}

// One tetrahedron with edges a thousand times those of the others: found, and no memory of a million buckets.
TEST(BucketGrid, TrianglesFarLongerThanTheMeanAreFound) {
  RawMesh raw = test::make_raw_box(12, 12, 12, {0.012, 0.012, 0.012});
  const auto far = static_cast<std::int32_t>(raw.positions.size());
  raw.positions.push_back({0.05, 0.06, 2.0});
  raw.tetrahedra.push_back(raw.tetrahedra.back());
  auto& last = raw.tetrahedra.back();
  for (auto& node : last) {
    if (raw.positions[static_cast<std::size_t>(node)].z() < 0.0115) node = far;
  }
  const TetraMesh mesh = check_mesh(raw, 1).mesh;
  const Surface surface = extract_surface(mesh, {});
  const std::vector<Vec3> at = surface_positions(mesh, surface);
  BucketGrid grid(surface, at, BucketGrid::suitable_slack(surface, at));
  EXPECT_GT(grid.overflow_count(), 0);
  const auto nearest = grid.nearest({0.05, 0.06, 2.1}, 1.0, at);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(std::sqrt(nearest->squared_distance), 0.1, 1e-12);
}

TEST_F(BucketGridTest, NearestPointAgreesWithBruteForce) {
  deform(0.5);
  update_all();
  for (int i = 0; i < test::tried(3000); ++i) {
    const Vec3 p = random_point(i % 2 ? 0.005 : 0.2);
    const double expected = brute_force_distance(p);
    const auto found = grid_.nearest(p, 10.0, now_);
    ASSERT_TRUE(found);
    ASSERT_EQ(std::sqrt(found->squared_distance), expected);
    const Triangle& t = surface_.triangles[found->triangle];
    const Vec3 point = found->barycentric[0] * now_[t[0]] + found->barycentric[1] * now_[t[1]] +
                       found->barycentric[2] * now_[t[2]];
    ASSERT_NEAR((point - p).norm(), expected, 1e-12);
  }
}

TEST_F(BucketGridTest, NearestPointRespectsTheLargestDistance) {
  for (int i = 0; i < test::tried(1000); ++i) {
    const Vec3 p = random_point(0.05);
    const double expected = brute_force_distance(p);
    EXPECT_FALSE(grid_.nearest(p, 0.999 * expected, now_));
    EXPECT_TRUE(grid_.nearest(p, 1.001 * expected, now_));
  }
}

TEST_F(BucketGridTest, QueriesAndTrianglesThatAreNotFiniteFindNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  int visits = 0;
  const auto count = [&](TriangleId) { ++visits; };
  grid_.visit_segment({nan, 0, 0}, rest_[0], 0.1, count);
  grid_.visit_segment(rest_[0], {0, inf, 0}, 0.1, count);
  grid_.visit_segment(rest_[0], rest_[0], nan, count);
  EXPECT_EQ(visits, 0);
  EXPECT_FALSE(grid_.nearest({0, 0, nan}, 1.0, now_));
  for (Vec3& p : now_) p.setConstant(nan);
  update_all();
  grid_.visit_segment(low_, high_, 0.1, count);
  EXPECT_EQ(visits, 0);
  now_ = rest_;
  update_all();
  EXPECT_GT(expect_no_miss(rest_[0] - 0.3 * Vec3::UnitX(), rest_[0] + 0.3 * Vec3::UnitX(), 0), 0);
}

TEST_F(BucketGridTest, EndlessSegmentsAreCutToTheSurface) {
  const Vec3 centre = 0.5 * (low_ + high_);
  EXPECT_GT(expect_no_miss(centre - Vec3(1e9, 1e9, 1e9), centre + Vec3(1e9, 1e9, 1e9), 0), 0);
}

TEST_F(BucketGridTest, ASlackOutsideItsRangeIsRefused) {
  EXPECT_THROW(BucketGrid(surface_, rest_, 0.0), std::invalid_argument);
  EXPECT_THROW(BucketGrid(surface_, rest_, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace omentum::geometry
