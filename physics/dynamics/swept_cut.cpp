#include "physics/dynamics/swept_cut.h"

#include "geometry/tetra_edges.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace omentum::physics {

namespace {

using geometry::TetId;
using geometry::Vec3;

constexpr std::int32_t kLeafSize = 4;  // as many as one box is worth
constexpr int kDeepest = 64;  // halves of 2^31 are one after 31 branchings, and each leaves one waiting
// Two projections that touch may come out as far apart as this share of their size: sums and products of
// three terms.
constexpr double kAxisRounding = 32 * std::numeric_limits<double>::epsilon();

constexpr std::array<std::array<int, 3>, 4> kFaces{{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

struct Interval {
  double low, high;
};

template <std::size_t n>
Interval project(const std::array<Vec3, n>& points, const Vec3& axis) {
  Interval shadow{axis.dot(points[0]), axis.dot(points[0])};
  for (std::size_t i = 1; i < n; ++i) {
    const double at = axis.dot(points[i]);
    shadow.low = std::min(shadow.low, at);
    shadow.high = std::max(shadow.high, at);
  }
  return shadow;
}

struct Separation {
  std::array<Vec3, 3> triangle;
  std::array<Vec3, 4> tetrahedron;
  double size;  // of both, m

  bool separated_along(const Vec3& axis) const {
    const Interval a = project(triangle, axis), b = project(tetrahedron, axis);
    const double slack = kAxisRounding * size * axis.lpNorm<1>();
    return a.low > b.high + slack || b.low > a.high + slack;
  }
};

// Seen from the tetrahedron's first corner, so that rounding is that of the pair, not of its place in W.
Separation pair_up(const std::array<Vec3, 3>& triangle, const std::array<Vec3, 4>& tetrahedron) {
  Separation pair{triangle, tetrahedron, 0};
  const Vec3& origin = tetrahedron[0];
  for (Vec3& p : pair.triangle) pair.size = std::max(pair.size, (p -= origin).lpNorm<Eigen::Infinity>());
  for (Vec3& p : pair.tetrahedron) pair.size = std::max(pair.size, (p -= origin).lpNorm<Eigen::Infinity>());
  return pair;
}

bool faces_separate(const Separation& pair) {
  const auto& [t, x, size] = pair;
  for (const auto& [a, b, c] : kFaces)
    if (pair.separated_along((x[b] - x[a]).cross(x[c] - x[a]))) return true;
  return pair.separated_along((t[1] - t[0]).cross(t[2] - t[0]));
}

bool edges_separate(const Separation& pair) {
  const auto& [t, x, size] = pair;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 along = t[(i + 1) % 3] - t[i];
    for (const auto& [a, b] : geometry::kTetraEdges)
      if (pair.separated_along(along.cross(x[b] - x[a]))) return true;
  }
  return false;
}

}  // namespace

bool meets(const std::array<Vec3, 3>& triangle, const std::array<Vec3, 4>& tetrahedron) {
  const Separation pair = pair_up(triangle, tetrahedron);
  return !faces_separate(pair) && !edges_separate(pair);
}

void SweptCut::Box::hold(const Vec3& point) {
  low = low.min(point.array());
  high = high.max(point.array());
}

void SweptCut::Box::hold(const Box& other) {
  low = low.min(other.low);
  high = high.max(other.high);
}

bool SweptCut::Box::apart_from(const Box& other) const {
  return (low > other.high).any() || (other.low > high).any();
}

SweptCut::SweptCut(const geometry::TetraMesh& mesh)
    : mesh_(mesh), places_(mesh.positions), order_(mesh.tetrahedra.size()) {
  for (std::size_t t = 0; t < order_.size(); ++t) order_[t] = TetId(t);
  std::vector<Vec3> centres;
  centres.reserve(order_.size());
  for (const TetId t : order_) {
    const auto x = corners(t);
    centres.push_back((x[0] + x[1] + x[2] + x[3]) / 4);
  }
  found_.reserve(order_.size());
  branches_.reserve(order_.size());
  grow(0, static_cast<std::int32_t>(order_.size()), centres);
  follow(std::vector<double>(3 * places_.size()));
}

// By halves along the longest side of the centres' box.
void SweptCut::grow(std::int32_t first, std::int32_t last, std::span<const Vec3> centres) {
  const std::size_t here = branches_.size();
  branches_.push_back({{}, first, last, 0});
  if (last - first <= kLeafSize) return;
  Box box;
  for (std::int32_t i = first; i < last; ++i) box.hold(centres[order_[i]]);
  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const std::int32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](TetId a, TetId b) { return centres[a][axis] < centres[b][axis]; });
  grow(first, middle, centres);
  branches_[here].second = static_cast<std::int32_t>(branches_.size());
  grow(middle, last, centres);
}

std::array<Vec3, 4> SweptCut::corners(TetId t) const {
  const geometry::Tetrahedron& nodes = mesh_.tetrahedra[t];
  std::array<Vec3, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = places_[nodes[i]];
  return x;
}

void SweptCut::follow(std::span<const double> displacements) noexcept {
  for (std::size_t n = 0; n < places_.size(); ++n)
    places_[n] = mesh_.positions[n] + Eigen::Map<const Vec3>(displacements.data() + 3 * n);
  // children stand behind their parents
  for (std::size_t i = branches_.size(); i-- > 0;) {
    Branch& branch = branches_[i];
    if (branch.second != 0) {
      branch.box = branches_[i + 1].box;
      branch.box.hold(branches_[branch.second].box);
      continue;
    }
    branch.box = {};
    for (std::int32_t k = branch.first; k < branch.last; ++k)
      for (const Vec3& corner : corners(order_[k])) branch.box.hold(corner);
  }
}

void SweptCut::collect(std::size_t leaf, const SweptEdge& edge, const Box& swept) noexcept {
  for (std::int32_t k = branches_[leaf].first; k < branches_[leaf].last; ++k) {
    const TetId t = order_[k];
    const auto x = corners(t);
    Box own;
    for (const Vec3& corner : x) own.hold(corner);
    if (own.apart_from(swept)) continue;
    if (meets({edge.from[0], edge.from[1], edge.to[1]}, x) ||
        meets({edge.from[0], edge.to[1], edge.to[0]}, x))
      found_.push_back(t);
  }
}

std::span<const TetId> SweptCut::find(const SweptEdge& edge) noexcept {
  found_.clear();
  Box swept;
  for (const Vec3& end : {edge.from[0], edge.from[1], edge.to[0], edge.to[1]}) swept.hold(end);
  std::array<std::int32_t, kDeepest> waiting{};
  int count = branches_.front().first < branches_.front().last ? 1 : 0;
  while (count > 0) {
    const auto here = static_cast<std::size_t>(waiting[--count]);
    if (branches_[here].box.apart_from(swept)) continue;
    if (branches_[here].second == 0) {
      collect(here, edge, swept);
      continue;
    }
    waiting[count++] = branches_[here].second;
    waiting[count++] = static_cast<std::int32_t>(here + 1);
  }
  std::sort(found_.begin(), found_.end());
  return found_;
}

}  // namespace omentum::physics
