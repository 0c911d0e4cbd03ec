#include "physics/intestine/gut_parts.h"

#include <cmath>

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

}  // namespace

GutParts::GutParts(const geometry::GutShape& shape)
    : layout(shape.layout), reach(geometry::reach_of(shape)), near(geometry::neighbourhood(shape)) {}

std::array<MassId, 3> GutParts::masses(std::int32_t part) const {
  if (!is_segment(part)) return layout.triangle(part - layout.segment_count());
  const auto [a, b] = layout.segment(part);
  return {a, b, MassId()};
}

Ball GutParts::ball_around(std::int32_t part, std::span<const Vec3> x) const {
  const std::array<MassId, 3> m = masses(part);
  const Vec3& third = m[2].valid() ? x[m[2]] : x[m[1]];
  const Vec3 low = x[m[0]].cwiseMin(x[m[1]]).cwiseMin(third);
  const Vec3 high = x[m[0]].cwiseMax(x[m[1]]).cwiseMax(third);
  return {(low + high) / 2, (high - low).norm() / 2};
}

bool GutParts::may_touch(std::int32_t segment, std::int32_t part) const {
  if (is_segment(part)) return near.may_touch(segment, part);
  return near.may_touch(segment, geometry::segment_above(layout, part - layout.segment_count()));
}

PairPlaces measure(const GutParts& parts, std::span<const Vec3> x, std::int32_t segment, std::int32_t part,
                   double farthest_m) noexcept {
  const auto [p, q] = parts.layout.segment(segment);
  const std::array<MassId, 3> m = parts.masses(part);
  if (parts.is_segment(part)) return between_segments(x[p], x[q], x[m[0]], x[m[1]]);
  return between_segment_and_triangle(x[p], x[q], {&x[m[0]], &x[m[1]], &x[m[2]]}, farthest_m);
}

GutContact contact_of(const GutParts& parts, std::span<const Vec3> x, std::int32_t segment, std::int32_t part,
                      const PairPlaces& places) noexcept {
  const auto [p, q] = parts.layout.segment(segment);
  GutContact contact;
  contact.one = {{p, q, MassId()}, {1 - places.s, places.s, 0}};
  contact.other = {parts.masses(part), {places.other[0], places.other[1], places.other[2]}};
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
