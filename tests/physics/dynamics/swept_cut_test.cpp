#include "physics/dynamics/swept_cut.h"

#include "tests/support/effort.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

using geometry::TetId;
using geometry::Vec3;
using Polygon = std::vector<Vec3>;

constexpr double kSide_m = 0.1;
// What an intersection has at least in common with a tetrahedron, or lacks at most, before the two ways of
// finding it are held to the same answer: far below a tetrahedron, far above rounding.
constexpr double kDoubt_m = 1e-12;

// The part of a polygon on the inner side of a plane that is moved outward by `grown`.
Polygon clip(const Polygon& polygon, const Vec3& point, const Vec3& outward, double grown) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = (a - point).dot(outward) - grown, at_b = (b - point).dot(outward) - grown;
    if (at_a <= 0) kept.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept;
}

// Nine tenths of all pairs, without a polygon.
bool far_apart(const std::array<Vec3, 3>& triangle, const std::array<Vec3, 4>& x) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto [a, b] = std::minmax({triangle[0][i], triangle[1][i], triangle[2][i]});
    const auto [c, d] = std::minmax({x[0][i], x[1][i], x[2][i], x[3][i]});
    if (a > d + kDoubt_m || c > b + kDoubt_m) return true;
  }
  return false;
}

// Whether anything of the triangle is left inside all four faces of the tetrahedron, each moved outward.
bool clipped_meets(const std::array<Vec3, 3>& triangle, const std::array<Vec3, 4>& x, double grown) {
  if (far_apart(triangle, x)) return false;
  Polygon left(triangle.begin(), triangle.end());
  for (std::size_t i = 0; i < 4 && !left.empty(); ++i) {
    const Vec3 &a = x[(i + 1) % 4], &b = x[(i + 2) % 4], &c = x[(i + 3) % 4];
    Vec3 normal = (b - a).cross(c - a).normalized();
    if ((x[i] - a).dot(normal) > 0) normal = -normal;
    left = clip(left, a, normal, grown);
  }
  return !left.empty();
}

/// A box of tissue, bent, and strokes through and past it.
class SweptCutTest : public testing::Test {
 protected:
  SweptCutTest() : mesh_(test::make_box_mesh(6, 5, 4, Vec3::Constant(kSide_m))), cut_(mesh_) {}

  void bend(double amplitude_m) {
    std::uniform_real_distribution<double> shake(-0.1 * amplitude_m, 0.1 * amplitude_m);
    displacements_.resize(3 * mesh_.positions.size());
    for (std::size_t n = 0; n < mesh_.positions.size(); ++n) {
      const Vec3 x = mesh_.positions[n] / kSide_m;
      const Vec3 u = amplitude_m * Vec3(std::sin(3 * x.y()), x.x() * x.z(), std::cos(2 * x.x()));
      for (Eigen::Index i = 0; i < 3; ++i)
        displacements_[3 * n + static_cast<std::size_t>(i)] = u[i] + shake(random_);
    }
    cut_.follow(displacements_);
  }
  std::array<Vec3, 4> corners(TetId t) const {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto n = mesh_.tetrahedra[t][i];
      x[i] = mesh_.positions[n] + Eigen::Map<const Vec3>(displacements_.data() + 3 * n);
    }
    return x;
  }
  Vec3 somewhere() {
    std::uniform_real_distribution<double> place(-0.2 * kSide_m, 1.2 * kSide_m);
    return {place(random_), place(random_), place(random_)};
  }
  // Every eighth stands still, every eighth moves along itself, some are short and some pass the whole organ.
  SweptEdge stroke(int i) {
    std::uniform_real_distribution<double> length(0, 0.5 * kSide_m);
    const Vec3 tip = somewhere(), along = (somewhere() - somewhere()).normalized() * length(random_);
    Vec3 way = (somewhere() - somewhere()) * (i % 2 == 0 ? 0.1 : 1);
    if (i % 8 == 1) way.setZero();
    if (i % 8 == 3) way = 0.7 * along;
    const Vec3 turn = i % 8 < 4 ? Vec3(Vec3::Zero()) : Vec3(0.3 * (somewhere() - somewhere()));
    return {{tip, tip + along}, {tip + way, tip + along + way + turn}};
  }

  std::mt19937 random_{7};
  geometry::TetraMesh mesh_;
  SweptCut cut_;
  std::vector<double> displacements_ = std::vector<double>(3 * mesh_.positions.size());
};

std::array<std::array<Vec3, 3>, 2> triangles_of(const SweptEdge& edge) {
  return {{{edge.from[0], edge.from[1], edge.to[1]}, {edge.from[0], edge.to[1], edge.to[0]}}};
}

TEST_F(SweptCutTest, TenThousandStrokesFindWhatClippingEachTetrahedronFinds) {
  std::size_t met = 0, doubtful = 0;
  for (int i = 0; i < test::tried(10000); ++i) {
    if (i % 100 == 0) bend(0.002 * (i % 1000) / 100);
    const SweptEdge edge = stroke(i);
    const auto found = cut_.find(edge);
    const auto [first, second] = triangles_of(edge);
    std::size_t next = 0;
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      const bool is_found = next < found.size() && found[next] == TetId(t);
      next += is_found;
      const auto x = corners(TetId(t));
      const bool inside = clipped_meets(first, x, -kDoubt_m) || clipped_meets(second, x, -kDoubt_m);
      const bool near = clipped_meets(first, x, kDoubt_m) || clipped_meets(second, x, kDoubt_m);
      doubtful += inside != near;
      ASSERT_TRUE(is_found ? near : !inside) << "stroke " << i << ", tetrahedron " << t;
    }
    ASSERT_EQ(next, found.size()) << "stroke " << i << ": repeated, out of order or out of range";
    met += found.size();
  }
  EXPECT_GT(met, 100u) << "strokes that miss prove nothing";
  EXPECT_LT(doubtful, met / 100);
}

// A triangle in the plane of faces touches the tetrahedra on both sides.
TEST_F(SweptCutTest, AStrokeAlongFacesMeetsBothSides) {
  const std::array<Vec3, 4> x{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const std::array<Vec3, 4> below{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)};
  const std::array<Vec3, 3> triangle{Vec3(0.1, 0.1, 0), Vec3(0.3, 0.1, 0), Vec3(0.1, 0.3, 0)};
  EXPECT_TRUE(meets(triangle, x));
  EXPECT_TRUE(meets(triangle, below));
}

TEST_F(SweptCutTest, AnEdgeThatStandsStillMeetsWhatItIsStuckIn) {
  const Vec3 tip = Vec3::Constant(0.5 * kSide_m), end = tip + Vec3(0.001, 0.0004, 0.0002);
  EXPECT_FALSE(cut_.find({{tip, end}, {tip, end}}).empty());
  EXPECT_FALSE(cut_.find({{tip, tip}, {tip, tip}}).empty()) << "not even an edge: a point";
}

// However fast: one stroke right through leaves nothing that joins both sides.
TEST_F(SweptCutTest, OneFastStrokeLeavesNoBridge) {
  bend(0.01);
  const double x = 0.53 * kSide_m;
  const auto found = cut_.find({{Vec3(x, -1, -1), Vec3(x, -1, 1)}, {Vec3(x, 1, -1), Vec3(x, 1, 1)}});
  std::vector<bool> gone(mesh_.tetrahedra.size());
  for (const TetId t : found) gone[static_cast<std::size_t>(t)] = true;
  int left = 0, right = 0;
  for (std::size_t t = 0; t < gone.size(); ++t) {
    if (gone[t]) continue;
    int sides = 0;
    for (const Vec3& corner : corners(TetId(t))) sides |= corner.x() < x ? 1 : 2;
    EXPECT_NE(sides, 3) << "tetrahedron " << t << " spans the cut";
    left += sides == 1;
    right += sides == 2;
  }
  EXPECT_GT(left, 0);
  EXPECT_GT(right, 0);
}

TEST_F(SweptCutTest, ItTakesNoMemory) {
  const SweptEdge through{{Vec3(0, 0, 0), Vec3(0, 0, kSide_m)},
                          {Vec3(kSide_m, kSide_m, 0), Vec3::Constant(kSide_m)}};
  const std::size_t before = test::heap_allocations();
  cut_.follow(displacements_);
  const bool any = !cut_.find(through).empty();
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_TRUE(any);
}

}  // namespace
}  // namespace omentum::physics
