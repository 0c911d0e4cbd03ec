// The parts of an intestine that may collide: segments of its axis, and triangles of its mesentery.
#pragma once

#include "geometry/gut_intersections.h"
#include "geometry/gut_neighbours.h"
#include "physics/intestine/gut_contact.h"
#include "physics/intestine/gut_distance.h"

#include <algorithm>
#include <span>
#include <vector>

namespace omentum::physics {

/// A ball around a part.
struct Ball {
  geometry::Vec3 centre;  // in W, m
  double radius_m;
};

/// Numbers of parts: the axis' segments first, behind them the mesentery's triangles. A pair is a segment
/// and any part behind it; of the mesentery with itself there is none (Raghupathi 2004, section 4.1). Along
/// the gut parts are no shorter than kFinest of the tube's radius: where masses are nearer to each other, a
/// part spans several, and the cost no longer grows with the square of their number. The tightest turn that
/// the tube can make lies within 3 % of the radius of its parts.
struct GutParts {
  geometry::GutLayout gut;     // of the masses
  std::int32_t stride = 1;     // columns of the gut from one column of the parts to the next
  geometry::GutLayout layout;  // of the parts; its numbers of masses are its own: own_mass() has the gut's
  geometry::GutReach reach;
  geometry::GutNeighbourhood near;
  std::vector<std::array<geometry::MassId, 3>> masses;  // [parts]; the third of a segment is none
  std::vector<std::int32_t> along;  // [parts]: the axis' segment itself, or the one that a triangle hangs on

  static constexpr double kFinest = 0.5;

  explicit GutParts(const geometry::GutShape& shape);

  /// The gut's mass at a corner of the parts' layout.
  geometry::MassId own_mass(geometry::MassId corner) const {
    return gut.mass(layout.row(corner), std::min(layout.column(corner) * stride, gut.columns - 1));
  }

  std::int32_t count() const { return static_cast<std::int32_t>(masses.size()); }
  bool is_segment(std::int32_t part) const { return part < layout.segment_count(); }
  double reach_m(std::int32_t part) const { return is_segment(part) ? reach.tube_m : reach.mesentery_m; }
  double least_reach_m() const { return std::min(reach.tube_m, reach.mesentery_m); }
  bool may_touch(std::int32_t segment, std::int32_t part) const {
    return near.may_touch(segment, along[part]);
  }
  Ball ball_around(std::int32_t part, std::span<const geometry::Vec3> x) const;
};

/// Closest points; exact up to `farthest_m`, of what is farther a lower bound that is farther too.
PairPlaces measure(const GutParts& parts, std::span<const geometry::Vec3> x, std::int32_t segment,
                   std::int32_t part, double farthest_m) noexcept;

/// Whether this pair is to report its closest points. Parts that share a corner or an edge find the same
/// points there; of those one part answers: the segment that begins there, the triangle with an even number
/// that begins there or has that edge. What lies on the axis' edge of the mesentery is the axis' business.
bool reports(const GutParts& parts, std::int32_t segment, std::int32_t part,
             const PairPlaces& places) noexcept;

/// What the response needs of a pair. Where the two cross, the normal is across both.
GutContact contact_of(const GutParts& parts, std::span<const geometry::Vec3> x, std::int32_t segment,
                      std::int32_t part, const PairPlaces& places) noexcept;

/// How far the masses of a pair that does not report may move, together, before that can have changed, m: how
/// steeply the distance falls towards the parts that answer instead, over how fast motion turns that slope.
/// 0 where it reports.
double quiet_way(const GutParts& parts, std::span<const geometry::Vec3> x, std::int32_t segment,
                 std::int32_t part, const PairPlaces& places) noexcept;

/// Where a point of masses is.
inline geometry::Vec3 place_of(const GutPoint& point, std::span<const geometry::Vec3> x) {
  geometry::Vec3 place = geometry::Vec3::Zero();
  for (std::size_t i = 0; i < 3 && point.mass[i].valid(); ++i) place += point.weight[i] * x[point.mass[i]];
  return place;
}

}  // namespace omentum::physics
