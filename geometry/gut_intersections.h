// Where an intestine overlaps itself or its mesentery.
#pragma once

#include "geometry/gut_neighbours.h"

#include <span>
#include <vector>

namespace omentum::geometry {

/// Two parts that are nearer to each other than they may be: a segment of the axis, and another one or a
/// triangle of the mesentery.
struct GutOverlap {
  std::int32_t segment = 0;
  std::int32_t other = 0;
  double distance_m = 0;  // between axis and axis, or axis and triangle; 0: one passes through the other
};

struct GutOverlaps {
  std::vector<GutOverlap> tube;       // segment < other, of the axis
  std::vector<GutOverlap> mesentery;  // other: a triangle
  bool empty() const { return tube.empty() && mesentery.empty(); }
};

/// How near two parts may be, m: the sums of what they reach around axis and sheet.
struct GutReach {
  double tube_m = 0;       // 2 r
  double mesentery_m = 0;  // r and half of the mesentery's thickness
};

inline GutReach reach_of(const GutShape& shape) {
  return {2 * shape.tube_radius_m, shape.tube_radius_m + shape.mesentery_thickness_m / 2};
}

/// All pairs that may touch and are nearer than their reach, in the order of segments. `positions`: [masses],
/// m. Exact but for rounding, O(n^2): what any faster search has to find.
GutOverlaps all_overlaps(const GutLayout& layout, std::span<const Vec3> positions, const GutReach& reach,
                         GutNeighbourhood near);
GutOverlaps all_overlaps(const GutShape& shape);

/// The same list for a shape, found through boxes around runs of columns: about O(n log n) where few parts
/// are near each other.
GutOverlaps find_overlaps(const GutShape& shape);

/// Between the axis of segment i and that of segment j, or triangle t of the mesentery, m.
double distance_of_segments(const GutLayout& layout, std::span<const Vec3> positions, std::int32_t i,
                            std::int32_t j);
double distance_to_triangle(const GutLayout& layout, std::span<const Vec3> positions, std::int32_t i,
                            std::int32_t t);

/// Distance tests of all_overlaps: pairs of segments, and of a segment and a triangle, that may touch.
std::int64_t exhaustive_tests(const GutLayout& layout, GutNeighbourhood near);

/// The smallest distances of any two parts that may touch, m; infinite where there are none.
GutReach smallest_distances(const GutShape& shape);

}  // namespace omentum::geometry
