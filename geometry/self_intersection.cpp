#include "geometry/self_intersection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omentum::geometry {
namespace {

using Nodes = std::array<std::int32_t, 3>;
using Box = Eigen::AlignedBox3d;

// Volumes below this fraction of the cube of their points' extent count as zero: 1000 times the rounding of
// the determinant, so that points of one plane never seem to cross it.
constexpr double kRounding = 1e-13;

// Triangles per leaf of the tree: below it testing all pairs is cheaper than descending.
constexpr std::size_t kLeafSize = 8;

// -1, 0 or 1: the side of (a,b,c) on which d lies, 0 within rounding.
int side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double extent = std::max({u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff()});
  const double volume = u.cross(v).dot(w);
  return std::abs(volume) <= kRounding * extent * extent * extent ? 0 : (volume > 0 ? 1 : -1);
}

class CrossingSearch {
 public:
  CrossingSearch(std::span<const Vec3> positions, std::span<const Nodes> triangles);

  std::vector<std::pair<std::size_t, std::size_t>> run();

 private:
  struct Range {
    std::size_t first, last;
    std::size_t size() const { return last - first; }
    std::size_t middle() const { return first + (last - first) / 2; }
  };

  void split(Range range, std::size_t cell);
  void within(Range range, std::size_t cell);
  void between(Range a, std::size_t cell_a, Range b, std::size_t cell_b);
  void test(std::size_t i, std::size_t j);
  bool edge_crosses(const Nodes& edges_of, const Nodes& triangle) const;
  const Vec3& at(std::int32_t node) const { return positions_[static_cast<std::size_t>(node)]; }

  std::span<const Vec3> positions_;
  std::span<const Nodes> triangles_;
  std::vector<Box> boxes_;          // of the triangles
  std::vector<std::size_t> order_;  // triangles, each cell of the tree a range
  std::vector<Box> cells_;          // of the tree: children of c are 2c + 1 and 2c + 2
  std::vector<std::pair<std::size_t, std::size_t>> found_;
};

CrossingSearch::CrossingSearch(std::span<const Vec3> positions, std::span<const Nodes> triangles)
    : positions_(positions), triangles_(triangles), boxes_(triangles.size()), order_(triangles.size()) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::int32_t node : triangles[t]) boxes_[t].extend(at(node));
  }
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) split({0, order_.size()}, 0);
}

void CrossingSearch::split(Range range, std::size_t cell) {
  if (cells_.size() <= cell) cells_.resize(cell + 1);
  Box box;
  for (std::size_t i = range.first; i < range.last; ++i) box.extend(boxes_[order_[i]]);
  cells_[cell] = box;
  if (range.size() <= kLeafSize) return;
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto begin = order_.begin();
  const auto offset = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  std::nth_element(
      begin + offset(range.first), begin + offset(range.middle()), begin + offset(range.last),
      [&](std::size_t s, std::size_t t) { return boxes_[s].center()[axis] < boxes_[t].center()[axis]; });
  split({range.first, range.middle()}, 2 * cell + 1);
  split({range.middle(), range.last}, 2 * cell + 2);
}

void CrossingSearch::within(Range range, std::size_t cell) {
  if (range.size() <= kLeafSize) {
    for (std::size_t i = range.first; i < range.last; ++i) {
      for (std::size_t j = i + 1; j < range.last; ++j) test(order_[i], order_[j]);
    }
    return;
  }
  const Range low{range.first, range.middle()};
  const Range high{range.middle(), range.last};
  within(low, 2 * cell + 1);
  within(high, 2 * cell + 2);
  between(low, 2 * cell + 1, high, 2 * cell + 2);
}

void CrossingSearch::between(Range a, std::size_t cell_a, Range b, std::size_t cell_b) {
  if (!cells_[cell_a].intersects(cells_[cell_b])) return;
  if (a.size() <= kLeafSize && b.size() <= kLeafSize) {
    for (std::size_t i = a.first; i < a.last; ++i) {
      for (std::size_t j = b.first; j < b.last; ++j) test(order_[i], order_[j]);
    }
  } else if (a.size() >= b.size()) {
    between({a.first, a.middle()}, 2 * cell_a + 1, b, cell_b);
    between({a.middle(), a.last}, 2 * cell_a + 2, b, cell_b);
  } else {
    between(b, cell_b, a, cell_a);
  }
}

// Does an edge of one triangle pass through the inside or the border of the other? Edges that start or
// end at a node of the other are their meeting, not a crossing.
bool CrossingSearch::edge_crosses(const Nodes& edges_of, const Nodes& triangle) const {
  const auto shared = [&](std::int32_t node) {
    return std::find(triangle.begin(), triangle.end(), node) != triangle.end();
  };
  const Vec3 &a = at(triangle[0]), &b = at(triangle[1]), &c = at(triangle[2]);
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
    if (shared(edges_of[i]) || shared(edges_of[j])) continue;
    const Vec3 &p = at(edges_of[i]), &q = at(edges_of[j]);
    if (side(a, b, c, p) * side(a, b, c, q) != -1) continue;
    const int s = side(p, q, a, b), t = side(p, q, b, c), u = side(p, q, c, a);
    const int lowest = std::min({s, t, u}), highest = std::max({s, t, u});
    if (lowest >= 0 || highest <= 0) return true;
  }
  return false;
}

void CrossingSearch::test(std::size_t i, std::size_t j) {
  if (!boxes_[i].intersects(boxes_[j])) return;
  const Nodes &a = triangles_[i], &b = triangles_[j];
  const auto shared = std::count_if(
      a.begin(), a.end(), [&](std::int32_t n) { return std::find(b.begin(), b.end(), n) != b.end(); });
  if (shared >= 2) return;
  if (edge_crosses(a, b) || edge_crosses(b, a)) found_.emplace_back(std::min(i, j), std::max(i, j));
}

std::vector<std::pair<std::size_t, std::size_t>> CrossingSearch::run() {
  if (!order_.empty()) within({0, order_.size()}, 0);
  std::sort(found_.begin(), found_.end());
  return std::move(found_);
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> crossing_triangles(std::span<const Vec3> positions,
                                                                    std::span<const Nodes> triangles) {
  return CrossingSearch(positions, triangles).run();
}

}  // namespace omentum::geometry
