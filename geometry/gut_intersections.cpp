#include "geometry/gut_intersections.h"

#include "geometry/precondition.h"
#include "geometry/segment_points.h"

#include <algorithm>
#include <limits>

namespace omentum::geometry {
namespace {

const Vec3& at(std::span<const Vec3> positions, MassId m) {
  return positions[static_cast<std::size_t>(m)];
}

// tube(segment, segment) and mesentery(segment, triangle), once for each pair that may touch.
template <class Tube, class Mesentery>
void visit_pairs(const GutLayout& layout, GutNeighbourhood near, Tube&& tube, Mesentery&& mesentery) {
  for (std::int32_t i = 0; i < layout.segment_count(); ++i) {
    for (std::int32_t j = i + near.columns_apart; j < layout.segment_count(); ++j) tube(i, j);
    for (std::int32_t t = 0; t < layout.triangle_count(); ++t)
      if (near.may_touch(i, segment_above(layout, t))) mesentery(i, t);
  }
}

}  // namespace

double distance_of_segments(const GutLayout& layout, std::span<const Vec3> x, std::int32_t i,
                            std::int32_t j) {
  const auto [a, b] = layout.segment(i);
  const auto [c, d] = layout.segment(j);
  return std::sqrt(closest_points_of_segments(at(x, a), at(x, b), at(x, c), at(x, d)).squared_distance);
}

double distance_to_triangle(const GutLayout& layout, std::span<const Vec3> x, std::int32_t i,
                            std::int32_t t) {
  const auto [p, q] = layout.segment(i);
  const auto [a, b, c] = layout.triangle(t);
  return std::sqrt(closest_points_of_segment_and_triangle(at(x, p), at(x, q), at(x, a), at(x, b), at(x, c))
                       .squared_distance);
}

GutOverlaps all_overlaps(const GutLayout& layout, std::span<const Vec3> positions, const GutReach& reach,
                         GutNeighbourhood near) {
  require(std::ssize(positions) == layout.mass_count(), "a position for each mass");
  GutOverlaps found;
  visit_pairs(
      layout, near,
      [&](std::int32_t i, std::int32_t j) {
        const double d = distance_of_segments(layout, positions, i, j);
        if (d < reach.tube_m) found.tube.push_back({i, j, d});
      },
      [&](std::int32_t i, std::int32_t t) {
        const double d = distance_to_triangle(layout, positions, i, t);
        if (d < reach.mesentery_m) found.mesentery.push_back({i, t, d});
      });
  return found;
}

GutOverlaps all_overlaps(const GutShape& shape) {
  return all_overlaps(shape.layout, shape.positions, reach_of(shape), neighbourhood(shape));
}

std::int64_t exhaustive_tests(const GutLayout& layout, GutNeighbourhood near) {
  std::int64_t tests = 0;
  visit_pairs(
      layout, near, [&](std::int32_t, std::int32_t) { ++tests; },
      [&](std::int32_t, std::int32_t) { ++tests; });
  return tests;
}

GutReach smallest_distances(const GutShape& shape) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  GutReach smallest{kNone, kNone};
  const GutLayout& layout = shape.layout;
  visit_pairs(
      layout, neighbourhood(shape),
      [&](std::int32_t i, std::int32_t j) {
        smallest.tube_m = std::min(smallest.tube_m, distance_of_segments(layout, shape.positions, i, j));
      },
      [&](std::int32_t i, std::int32_t t) {
        smallest.mesentery_m =
            std::min(smallest.mesentery_m, distance_to_triangle(layout, shape.positions, i, t));
      });
  return smallest;
}

}  // namespace omentum::geometry
