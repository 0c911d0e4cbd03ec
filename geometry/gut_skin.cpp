#include "geometry/gut_skin.h"

#include "geometry/across.h"
#include "geometry/tube_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::geometry {
namespace {

constexpr std::size_t kFewestAround = 6;
// Of the ring before, beside what the mesentery says: little where that is known, all where it is not.
constexpr double kCarried = 0.1;
// Below this a mesentery has no width, and a direction only by rounding.
constexpr double kNoWidth_m = 1e-6;
// Of a mesentery that is not narrower than this somewhere, nothing is left out.
constexpr double kLeastArea_m2 = 1e-8;

std::size_t nodes_around(double radius_m) {
  const double count = std::round(2 * std::numbers::pi * radius_m / GutSkin::kSkinEdge_m);
  return std::max(kFewestAround, static_cast<std::size_t>(count));
}

// Masses before and behind the ends lie on the parabola through the three next ones (ghost_before).
void add(const GutLayout& layout, std::int32_t column, double weight, GutSkin::Node& node) {
  const std::int32_t last = layout.columns - 1;
  if (column < 0 || column > last) {
    const std::int32_t end = column < 0 ? 0 : last, inward = column < 0 ? 1 : -1;
    add(layout, end, 3 * weight, node);
    add(layout, end + inward, -3 * weight, node);
    return add(layout, end + 2 * inward, weight, node);
  }
  const MassId mass = layout.mass(0, column);
  std::size_t k = 0;
  while (node.weight[k] != 0 && node.mass[k] != mass) ++k;
  node.mass[k] = mass;
  node.weight[k] += weight;
}

GutSkin::Node on_spline(const GutLayout& layout, std::int32_t segment, const Eigen::Vector4d& weights) {
  GutSkin::Node node;
  for (std::int32_t c = 0; c < 4; ++c) add(layout, segment - 1 + c, weights[c], node);
  return node;
}

}  // namespace

Vec3 weighted(const GutSkin::Node& node, std::span<const Vec3> x) noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < GutSkin::kMostWeights; ++k)
    if (node.weight[k] != 0) sum += node.weight[k] * x[static_cast<std::size_t>(node.mass[k])];
  return sum;
}

GutSkin::GutSkin(const GutShape& shape)
    : layout_(shape.layout),
      radius_m_(shape.tube_radius_m),
      half_thickness_m_(shape.mesentery_thickness_m / 2),
      around_(nodes_around(shape.tube_radius_m)) {
  for (std::size_t i = 0; i < around_; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(around_);
    circle_.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  add_rings(shape);
  add_tube_triangles();
  add_sheet(shape);
}

bool GutSkin::is_held(NodeId n) const {
  const Node& of = node(n);
  for (std::size_t k = 0; k < kMostWeights; ++k)
    if (of.weight[k] != 0 && !layout_.is_held(of.mass[k])) return false;
  return true;
}

void GutSkin::add_rings(const GutShape& shape) {
  double since_m = kSkinEdge_m;  // the last ring
  for (std::int32_t i = 0; i < layout_.segment_count(); ++i) {
    const auto [a, b] = layout_.segment(i);
    const double length_m =
        (shape.positions[static_cast<std::size_t>(b)] - shape.positions[static_cast<std::size_t>(a)]).norm();
    if (since_m + 0.5 * length_m < kSkinEdge_m) {  // many masses to a ring
      since_m += length_m;
      continue;
    }
    const auto rings = std::max(1, static_cast<int>(std::round(length_m / kSkinEdge_m)));
    for (int r = 0; r < rings; ++r) add_ring(i, static_cast<double>(r) / rings);
    since_m = length_m / rings;
  }
  add_ring(layout_.segment_count() - 1, 1);
}

void GutSkin::add_ring(std::int32_t segment, double at) {
  rings_.push_back({segment, at, on_spline(layout_, segment, cardinal_weights(at)),
                    on_spline(layout_, segment, cardinal_slopes(at))});
  nodes_.insert(nodes_.end(), around_, rings_.back().centre);
}

void GutSkin::add_tube_triangles() {
  for (std::size_t r = 0; r + 1 < rings_.size(); ++r) {
    for (std::size_t i = 0; i < around_; ++i) {
      const std::size_t next = (i + 1) % around_;
      const NodeId a(r * around_ + i), b(r * around_ + next), c(a + around_), d(b + around_);
      triangles_.push_back({a, b, c});
      triangles_.push_back({b, d, c});
    }
  }
}

void GutSkin::add_sheet(const GutShape& shape) {
  for (const bool is_upper : {true, false}) {
    const std::size_t first = nodes_.size();
    for (std::int32_t row = 0; row < layout_.rows; ++row) {
      for (std::int32_t column = 0; column < layout_.columns; ++column) {
        Node node{{layout_.mass(row, column)}, {1}};
        if (row == 0) {  // the sheet begins at the tube's wall, not at its axis
          const MassId one = layout_.mass(1, column);
          const double width_m = (shape.positions[static_cast<std::size_t>(one)] -
                                  shape.positions[static_cast<std::size_t>(node.mass[0])])
                                     .norm();
          const double share = width_m > radius_m_ ? radius_m_ / width_m : 1;
          node = {{node.mass[0], one}, {1 - share, share}};
        }
        nodes_.push_back(node);
      }
    }
    add_face_triangles(shape, first, is_upper);
  }
}

void GutSkin::add_face_triangles(const GutShape& shape, std::size_t first, bool is_upper) {
  const auto place = [&](MassId m) {
    return weighted(nodes_[first + static_cast<std::size_t>(m)], shape.positions);
  };
  for (std::int32_t t = 0; t < layout_.triangle_count(); ++t) {
    auto [a, b, c] = layout_.triangle(t);
    if (0.5 * (place(b) - place(a)).cross(place(c) - place(a)).norm() < kLeastArea_m2) continue;
    if (!is_upper) std::swap(b, c);
    const auto node = [first](MassId m) { return NodeId(first + static_cast<std::size_t>(m)); };
    triangles_.push_back({node(a), node(b), node(c)});
  }
}

void GutSkin::place(std::span<const Vec3> x, std::span<Vec3> places) const noexcept {
  place_tube(x, places);
  place_sheet(x, places);
}

Vec3 GutSkin::towards_mesentery(std::span<const Vec3> x, const Ring& ring) const noexcept {
  const auto hangs = [&](std::int32_t column) -> Vec3 {
    return x[static_cast<std::size_t>(layout_.mass(1, column))] -
           x[static_cast<std::size_t>(layout_.mass(0, column))];
  };
  const Vec3 way = (1 - ring.at) * hangs(ring.segment) + ring.at * hangs(ring.segment + 1);
  const double length = way.norm();
  return length > kNoWidth_m ? Vec3(way / length) : Vec3::Zero();
}

void GutSkin::place_tube(std::span<const Vec3> x, std::span<Vec3> places) const noexcept {
  Vec3 before = Vec3::Zero(), tangent = Vec3::UnitZ();
  // the first ring, at the held end, has no mesentery of its own
  for (std::size_t r = 0; r < rings_.size() && before.isZero(); ++r) before = towards_mesentery(x, rings_[r]);
  for (std::size_t r = 0; r < rings_.size(); ++r) {
    const Vec3 rate = weighted(rings_[r].along, x);
    if (rate.squaredNorm() > 0) tangent = rate.normalized();
    Vec3 one = across(towards_mesentery(x, rings_[r]) + kCarried * before, tangent);
    one = one.squaredNorm() > 1e-12 ? one.normalized() : tangent.unitOrthogonal();
    const Vec3 other = tangent.cross(one), centre = weighted(rings_[r].centre, x);
    for (std::size_t i = 0; i < around_; ++i)
      places[r * around_ + i] = centre + radius_m_ * (circle_[i].x() * one + circle_[i].y() * other);
    before = one;
  }
}

// Of the triangles in the four cells around a mass, by area.
Vec3 GutSkin::sheet_normal(std::span<const Vec3> x, std::int32_t row, std::int32_t column) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::int32_t r = std::max(0, row - 1); r <= std::min(row, layout_.rows - 2); ++r) {
    for (std::int32_t c = std::max(0, column - 1); c <= std::min(column, layout_.columns - 2); ++c) {
      for (std::int32_t half = 0; half < 2; ++half) {
        const auto t = layout_.triangle(2 * (r * (layout_.columns - 1) + c) + half);
        const auto at = [&](int v) { return x[static_cast<std::size_t>(t[static_cast<std::size_t>(v)])]; };
        sum += (at(1) - at(0)).cross(at(2) - at(0));
      }
    }
  }
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : Vec3::Zero();
}

void GutSkin::place_sheet(std::span<const Vec3> x, std::span<Vec3> places) const noexcept {
  const std::size_t first = rings_.size() * around_, count = static_cast<std::size_t>(layout_.mass_count());
  for (std::size_t m = 0; m < count; ++m) {
    const MassId mass(m);
    const Vec3 middle = weighted(nodes_[first + m], x);
    const Vec3 way = half_thickness_m_ * sheet_normal(x, layout_.row(mass), layout_.column(mass));
    places[first + m] = middle + way;
    places[first + count + m] = middle - way;
  }
}

}  // namespace omentum::geometry
