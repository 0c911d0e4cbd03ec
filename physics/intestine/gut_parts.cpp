#include "physics/intestine/gut_parts.h"

#include <cmath>
#include <limits>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// Two parts as near as this cross: the direction between them is rounding.
constexpr double kCrossing_m = 1e-12;

// Across a segment and a part that it passes through.
Vec3 across(const Vec3& along, const std::array<Vec3, 3>& at, bool is_segment) {
  const Vec3 edge = at[1] - at[0];
  const Vec3 normal = is_segment ? along.cross(edge) : edge.cross(at[2] - at[0]);
  return normal.squaredNorm() > 0 ? normal.normalized() : Vec3(along.unitOrthogonal());
}

// Columns of the gut for one of the parts.
std::int32_t stride_of(const geometry::GutShape& shape) {
  double length_m = 0;
  for (std::int32_t i = 0; i < shape.layout.segment_count(); ++i) {
    const auto [a, b] = shape.layout.segment(i);
    length_m += (shape.positions[b] - shape.positions[a]).norm();
  }
  const double columns = GutParts::kFinest * shape.tube_radius_m * shape.layout.segment_count() / length_m;
  const std::int32_t most =
      std::max(1, shape.layout.segment_count() / 3);  // a layout has four columns at least
  return std::isfinite(columns) ? std::clamp(static_cast<std::int32_t>(columns + 1e-6), 1, most) : 1;
}

// Whether another segment, which may touch `part` too, begins where this one ends.
bool goes_on(const GutParts& parts, std::int32_t segment, std::int32_t part) {
  return segment + 1 < parts.layout.segment_count() && parts.may_touch(segment + 1, part);
}

// A triangle's corner or edge with a weight of 0: whether it answers for that. Even triangles have the
// corners (r, c), (r + 1, c), (r, c + 1), odd ones (r, c + 1), (r + 1, c), (r + 1, c + 1): each inner edge is
// one even and one odd triangle's, each inner corner is the first one of one even triangle.
bool triangle_reports(const GutParts& parts, std::int32_t segment, std::int32_t part, const Vec3& weights) {
  const std::int32_t t = part - parts.layout.segment_count();
  const std::array<MassId, 3> m = parts.layout.triangle(t);
  const auto in_row = [&](int i) { return weights[i] == 0 || parts.layout.row(m[i]) == 0; };
  if (in_row(0) && in_row(1) && in_row(2)) return false;
  const int zeros = static_cast<int>((weights.array() == 0).count());
  if (zeros == 0) return true;
  if (t % 2 == 0 && (zeros == 1 || weights[0] > 0)) return true;
  Eigen::Index corner = 0;
  weights.maxCoeff(&corner);
  const geometry::GutLayout& layout = parts.layout;
  // the even triangle that would answer: the one that begins at the corner, or lies across the edge
  std::int32_t row = layout.row(m[corner]), column = layout.column(m[corner]);
  if (zeros == 1) {
    row = layout.row(m[0]) + (weights[0] == 0 ? 1 : 0);
    column = layout.column(m[1]) + (weights[1] == 0 ? 1 : 0);
  }
  const bool there = row < layout.rows - 1 && column < layout.columns - 1;
  return !there || !parts.near.may_touch(segment, column);
}

}  // namespace

GutParts::GutParts(const geometry::GutShape& shape)
    : gut(shape.layout),
      stride(stride_of(shape)),
      layout{gut.rows, 1 + (gut.columns - 2 + stride) / stride},
      reach(geometry::reach_of(shape)) {
  geometry::GutShape own{layout, {}, shape.tube_radius_m, shape.mesentery_thickness_m};
  for (std::int32_t m = 0; m < layout.mass_count(); ++m)
    own.positions.push_back(shape.positions[own_mass(MassId(m))]);
  near = geometry::neighbourhood(own);
  for (std::int32_t i = 0; i < layout.segment_count(); ++i) {
    const auto [a, b] = layout.segment(i);
    masses.push_back({own_mass(a), own_mass(b), MassId()});
    along.push_back(i);
  }
  for (std::int32_t t = 0; t < layout.triangle_count(); ++t) {
    const auto [a, b, c] = layout.triangle(t);
    masses.push_back({own_mass(a), own_mass(b), own_mass(c)});
    along.push_back(geometry::segment_above(layout, t));
  }
}

Ball GutParts::ball_around(std::int32_t part, std::span<const Vec3> x) const {
  const std::array<MassId, 3> m = masses[part];
  const Vec3& third = m[2].valid() ? x[m[2]] : x[m[1]];
  const Vec3 low = x[m[0]].cwiseMin(x[m[1]]).cwiseMin(third);
  const Vec3 high = x[m[0]].cwiseMax(x[m[1]]).cwiseMax(third);
  return {(low + high) / 2, (high - low).norm() / 2};
}

PairPlaces measure(const GutParts& parts, std::span<const Vec3> x, std::int32_t segment, std::int32_t part,
                   double farthest_m) noexcept {
  const MassId p = parts.masses[segment][0], q = parts.masses[segment][1];
  const std::array<MassId, 3> m = parts.masses[part];
  if (parts.is_segment(part)) return between_segments(x[p], x[q], x[m[0]], x[m[1]]);
  return between_segment_and_triangle(x[p], x[q], {&x[m[0]], &x[m[1]], &x[m[2]]}, farthest_m);
}

bool reports(const GutParts& parts, std::int32_t segment, std::int32_t part,
             const PairPlaces& places) noexcept {
  if (places.s == 1 && goes_on(parts, segment, part)) return false;
  if (!parts.is_segment(part)) return triangle_reports(parts, segment, part, places.other);
  return places.other[1] != 1 || !goes_on(parts, part, segment);
}

double quiet_way(const GutParts& parts, std::span<const Vec3> x, std::int32_t segment, std::int32_t part,
                 const PairPlaces& places) noexcept {
  const MassId p = parts.masses[segment][0], q = parts.masses[segment][1];
  const std::array<MassId, 3>& m = parts.masses[part];
  const Vec3 one = x[p] + places.s * (x[q] - x[p]);
  const Vec3 other = places.other[0] * x[m[0]] + places.other[1] * x[m[1]] +
                     (m[2].valid() ? Vec3(places.other[2] * x[m[2]]) : Vec3(Vec3::Zero()));
  const Vec3 apart = one - other;
  // along `edge`, which leaves the closest point, the distance would grow: by the projection upon it
  const auto way = [&](const Vec3& edge, double rising) {
    return std::max(0.0, rising) / (4 * apart.norm() + 2 * edge.norm());
  };
  if (places.s == 1 && goes_on(parts, segment, part)) return way(x[q] - x[p], -apart.dot(x[q] - x[p]));
  Eigen::Index corner = 0;
  places.other.maxCoeff(&corner);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3 && m[static_cast<std::size_t>(k)].valid(); ++k) {
    if (places.other[k] > 0) continue;
    const Vec3 edge = x[m[static_cast<std::size_t>(k)]] - x[m[static_cast<std::size_t>(corner)]];
    least = std::min(least, way(edge, -apart.dot(edge)));
  }
  return std::isfinite(least) ? least : 0;
}

GutContact contact_of(const GutParts& parts, std::span<const Vec3> x, std::int32_t segment, std::int32_t part,
                      const PairPlaces& places) noexcept {
  const MassId p = parts.masses[segment][0], q = parts.masses[segment][1];
  GutContact contact;
  contact.one = {{p, q, MassId()}, {1 - places.s, places.s, 0}};
  contact.other = {parts.masses[part], {places.other[0], places.other[1], places.other[2]}};
  contact.reach_m = parts.reach_m(part);
  const Vec3 between = place_of(contact.one, x) - place_of(contact.other, x);
  if (places.distance_m > kCrossing_m) {
    contact.normal = between / places.distance_m;
  } else {
    const std::array<MassId, 3>& m = contact.other.mass;
    const bool is_segment = parts.is_segment(part);
    contact.normal = across(x[q] - x[p], {x[m[0]], x[m[1]], x[is_segment ? m[1] : m[2]]}, is_segment);
  }
  return contact;
}

}  // namespace omentum::physics
