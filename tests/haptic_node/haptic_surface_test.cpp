#include "haptic_node/deformed_surface.h"

#include "geometry/closest_points.h"
#include "haptic_fixtures.h"
#include "tests/support/effort.h"

#include <random>
#include <set>

namespace omentum::haptic_test {
namespace {

using haptic::DeformedSurface;
using haptic::Entry;
using haptic::SurfacePoint;

Vec3 uniform(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> draw(low, high);
  return {draw(random), draw(random), draw(random)};
}

/// Random forces on random distinct mobile nodes that move the surface by about a centimetre.
struct RandomForces {
  std::vector<SurfaceId> nodes;
  std::vector<Vec3> forces;

  RandomForces(const TestOrgan& organ, int count, double newton, std::mt19937& random) {
    std::vector<std::int32_t> ids(organ.surface.mobile_count);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int32_t>(i);
    std::shuffle(ids.begin(), ids.end(), random);
    for (int i = 0; i < count; ++i) {
      nodes.emplace_back(ids[i]);
      forces.push_back(uniform(random, -newton, newton));
    }
  }

  std::vector<Vec3> positions(const TestOrgan& organ) const {
    std::vector<Vec3> x = organ.rest;
    for (std::int32_t n = 0; n < organ.surface.mobile_count; ++n) {
      for (std::size_t q = 0; q < nodes.size(); ++q)
        x[n] += organ.compliance.block(SurfaceId(n), nodes[q]) * forces[q];
    }
    return x;
  }
};

// Float superposition of displacements of a centimetre, and float coordinates.
constexpr double kPositionTolerance_m = 1e-7;

TEST(DeformedSurface, EqualsTheSuperposedForcesWhereItIsAsked) {
  std::mt19937 random(1);
  DeformedSurface surface(block().surface, block().rest, block().compliance);
  for (int trial = 0; trial < 20; ++trial) {
    const RandomForces f(block(), 1 + trial, 0.5, random);
    surface.set_forces(f.nodes, f.forces);
    const std::vector<Vec3> expected = f.positions(block());
    for (std::int32_t n = 0; n < block().surface.node_count(); n += 7) {
      EXPECT_LE((surface.position(SurfaceId(n)) - expected[n]).norm(), kPositionTolerance_m);
    }
  }
}

// Forces that come, go and change: no corner of a triangle goes farther than its bound.
TEST(DeformedSurface, NothingGoesFartherThanTheBoundOfAChange) {
  std::mt19937 random(2);
  DeformedSurface surface(block().surface, block().rest, block().compliance);
  RandomForces before(block(), 6, 0.5, random);
  for (int trial = 0; trial < 20; ++trial) {
    RandomForces after(block(), 6, 0.5, random);
    for (int same = 0; same < 3; ++same) after.nodes[same] = before.nodes[same];
    if (std::set(after.nodes.begin(), after.nodes.end()).size() < after.nodes.size()) continue;
    surface.set_forces(before.nodes, before.forces);
    surface.propose(after.nodes, after.forces);
    const std::vector<Vec3> x = before.positions(block()), y = after.positions(block());
    for (std::size_t t = 0; t < block().surface.triangles.size(); ++t) {
      const double bound = surface.motion_bound({TriangleId(t), Vec3(1, 0, 0)});
      for (const SurfaceId n : block().surface.triangles[t])
        EXPECT_LE((y[n] - x[n]).norm(), bound + kPositionTolerance_m);
    }
    before = after;
  }
}

std::optional<Entry> brute_force_entry(const TestOrgan& organ, const std::vector<Vec3>& x, const Vec3& p,
                                       const Vec3& q) {
  std::optional<Entry> first;
  for (std::size_t t = 0; t < organ.surface.triangles.size(); ++t) {
    const geometry::Triangle& v = organ.surface.triangles[t];
    const Vec3 &a = x[v[0]], &b = x[v[1]], &c = x[v[2]];
    if ((q - p).dot((b - a).cross(c - a)) >= 0) continue;
    const auto hit = geometry::intersect_segment_triangle(p, q, a, b, c);
    if (hit && (!first || hit->parameter < first->parameter)) {
      first = Entry{hit->parameter, {TriangleId(t), hit->barycentric}};
    }
  }
  return first;
}

// Compares `count` random fast segments (up to 6 cm in a tick) with brute force, over many changes of force.
void expect_no_miss(const TestOrgan& organ, int count, double newton, unsigned seed) {
  std::mt19937 random(seed);
  DeformedSurface surface(organ.surface, organ.rest, organ.compliance);
  Vec3 low = organ.rest[0], high = organ.rest[0];
  for (const Vec3& p : organ.rest) low = low.cwiseMin(p), high = high.cwiseMax(p);
  constexpr int kPerForce = 250;
  int entries = 0;
  for (int done = 0; done < count; done += kPerForce) {
    const RandomForces f(organ, 1 + static_cast<int>(random() % 24), newton, random);
    surface.set_forces(f.nodes, f.forces);
    std::vector<Vec3> x = organ.rest;
    for (std::int32_t n = 0; n < organ.surface.node_count(); ++n) x[n] = surface.position(SurfaceId(n));
    // a few ticks without looking: boxes and buckets fall behind, as they do far from the tools
    for (int blind = 0; blind < 3; ++blind) {
      const RandomForces g(organ, 8, newton, random);
      surface.set_forces(g.nodes, g.forces);
    }
    surface.set_forces(f.nodes, f.forces);
    for (int i = 0; i < kPerForce; ++i) {
      const Vec3 start =
          (low + uniform(random, 0, 1).cwiseProduct(high - low)).eval() + uniform(random, -0.02, 0.02);
      const Vec3 end = start + uniform(random, -0.035, 0.035);
      surface.evaluate({start.cwiseMin(end), start.cwiseMax(end)});
      const auto found = surface.first_entry(start, end), expected = brute_force_entry(organ, x, start, end);
      ASSERT_EQ(found.has_value(), expected.has_value()) << "segment " << done + i;
      if (!found) continue;
      ++entries;
      EXPECT_NEAR(found->parameter, expected->parameter, 1e-9);
    }
  }
  EXPECT_GT(entries, count / 10) << "the segments were meant to hit";
}

TEST(DeformedSurface, FastSegmentsAgreeWithBruteForceOnABlock) {
  expect_no_miss(block(), test::tried(50'000), 0.5, 2);
}

TEST(DeformedSurface, FastSegmentsAgreeWithBruteForceOnAThinPlate) {
  expect_no_miss(plate(), test::tried(50'000), 0.002, 3);
}

// A dent that grows, wanders and goes again, a little in each tick, looked at around a moving place only:
// boxes and buckets elsewhere live on bounds for hundreds of ticks.
TEST(DeformedSurface, SegmentsAgreeWithBruteForceWhileDentsDrift) {
  constexpr int kTicks = 4000, kSegments = 4;
  std::mt19937 random(7);
  const TestOrgan& organ = block();
  DeformedSurface surface(organ.surface, organ.rest, organ.compliance),
      reference(organ.surface, organ.rest, organ.compliance);
  RandomForces f(organ, 12, 0.0, random);
  int entries = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    for (std::size_t q = 0; q < f.forces.size(); ++q) {
      const double phase = 0.01 * tick + static_cast<double>(q);
      f.forces[q] = Vec3(0.1 * std::sin(phase), 0.1 * std::cos(0.7 * phase), -0.6 * std::sin(0.4 * phase));
    }
    surface.set_forces(f.nodes, f.forces);
    reference.set_forces(f.nodes, f.forces);
    std::vector<Vec3> x = organ.rest;
    for (std::int32_t n = 0; n < organ.surface.node_count(); ++n) x[n] = reference.position(SurfaceId(n));
    const Vec3 centre(0.05 + 0.04 * std::sin(0.003 * tick), 0.05 + 0.04 * std::cos(0.002 * tick), 0.035);
    surface.evaluate({centre - Vec3::Constant(0.01), centre + Vec3::Constant(0.01)});
    for (int i = 0; i < kSegments; ++i) {
      const Vec3 start = centre + uniform(random, -0.01, 0.01), end = centre + uniform(random, -0.01, 0.01);
      const auto found = surface.first_entry(start, end), expected = brute_force_entry(organ, x, start, end);
      ASSERT_EQ(found.has_value(), expected.has_value()) << "tick " << tick;
      if (!found) continue;
      ++entries;
      EXPECT_NEAR(found->parameter, expected->parameter, 1e-9);
    }
  }
  EXPECT_GT(entries, kTicks * kSegments / 20) << "the segments were meant to hit";
}

TEST(DeformedSurface, FindsThePointsThatLieInside) {
  std::mt19937 random(4);
  DeformedSurface surface(block().surface, block().rest, block().compliance);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 p = uniform(random, 0, 0.12) - Vec3(0.01, 0.01, 0.01);
    surface.evaluate({p - Vec3::Constant(0.01), p + Vec3::Constant(0.01)});
    const Vec3 depth = p.cwiseMin(Vec3(0.1, 0.1, 0.04) - p);
    const bool inside = depth.minCoeff() > 0 && depth.minCoeff() < 0.005;
    EXPECT_EQ(surface.nearest_if_inside(p, 0.005).has_value(), inside) << p.transpose();
  }
}

TEST(DeformedSurface, ImmersionIsTheDepthBelowTheNearestFace) {
  std::mt19937 random(5);
  DeformedSurface surface(block().surface, block().rest, block().compliance);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 p = uniform(random, 0, 0.12) - Vec3(0.01, 0.01, 0.01);
    const double depth = p.cwiseMin(Vec3(0.1, 0.1, 0.04) - p).minCoeff();
    const auto inside = surface.immersion(p, 0.05);
    ASSERT_EQ(inside.has_value(), depth > 0) << p.transpose();
    EXPECT_NEAR(inside ? inside->depth_m : 0, std::max(depth, 0.0), 1e-9);
  }
}

TEST(DeformedSurface, NormalsAreContinuousAcrossEdges) {
  DeformedSurface surface(block().surface, block().rest, block().compliance);
  // around the block: between points 20 um apart a normal turns by no more than over one element of 10 mm in
  // all
  constexpr double kStep_m = 2e-5, kMaxTurn = 3 * kStep_m / 0.01;
  SurfacePoint at = {TriangleId(0), Vec3(1, 0, 0)};
  at = surface.slide(at, Vec3(-0.01, 0.033, 0.02));
  std::vector<Vec3> path = {{0, 0.033, 0.02}, {0, 0.037, 0.04}, {0.1, 0.041, 0.04}, {0.1, 0.057, 0.0}};
  Vec3 before = surface.normal(at);
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
    const Vec3 way = path[leg + 1] - path[leg];
    for (double s = 0; s < 1; s += kStep_m / way.norm()) {
      at = surface.slide(at, path[leg] + s * way);
      const Vec3 n = surface.normal(at);
      EXPECT_NEAR(n.norm(), 1, 1e-12);
      EXPECT_LE((n - before).norm(), kMaxTurn);
      before = n;
    }
  }
}

TEST(DeformedSurface, SlidingFindsTheClosestPoint) {
  std::mt19937 random(6);
  DeformedSurface surface(block().surface, block().rest, block().compliance);
  // a convex body: the closest point is the only local one
  SurfacePoint at = {TriangleId(0), Vec3(1, 0, 0)};
  for (int i = 0; i < 500; ++i) {
    Vec3 p = uniform(random, -0.02, 0.12);
    p.z() = 0.04 + std::abs(p.z());
    at = surface.slide(at, p);
    const Vec3 expected = p.cwiseMax(Vec3::Zero()).cwiseMin(Vec3(0.1, 0.1, 0.04));
    EXPECT_LE((surface.position(at) - expected).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace omentum::haptic_test
