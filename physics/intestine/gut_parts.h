// The parts of an intestine that may collide: segments of its axis, and triangles of its mesentery.
#pragma once

#include "geometry/gut_intersections.h"
#include "geometry/gut_neighbours.h"
#include "physics/intestine/gut_contact.h"
#include "physics/intestine/gut_distance.h"

#include <span>

namespace omentum::physics {

/// A ball around a part.
struct Ball {
  geometry::Vec3 centre;  // in W, m
  double radius_m;
};

/// Numbers of parts: the axis' segments first, behind them the mesentery's triangles. A pair is a segment
/// and any part behind it; of the mesentery with itself there is none (Raghupathi 2004, section 4.1).
struct GutParts {
  geometry::GutLayout layout;
  geometry::GutReach reach;
  geometry::GutNeighbourhood near;

  explicit GutParts(const geometry::GutShape& shape);

  std::int32_t count() const { return layout.segment_count() + layout.triangle_count(); }
  bool is_segment(std::int32_t part) const { return part < layout.segment_count(); }
  double reach_m(std::int32_t part) const { return is_segment(part) ? reach.tube_m : reach.mesentery_m; }
  double least_reach_m() const { return std::min(reach.tube_m, reach.mesentery_m); }
  /// Of a segment or triangle; the third of a segment is none.
  std::array<geometry::MassId, 3> masses(std::int32_t part) const;
  Ball ball_around(std::int32_t part, std::span<const geometry::Vec3> x) const;
  bool may_touch(std::int32_t segment, std::int32_t part) const;
};

/// Closest points; exact up to `farthest_m`, of what is farther a lower bound that is farther too.
PairPlaces measure(const GutParts& parts, std::span<const geometry::Vec3> x, std::int32_t segment,
                   std::int32_t part, double farthest_m) noexcept;

/// What the response needs of a pair. Where the two cross, the normal is across both.
GutContact contact_of(const GutParts& parts, std::span<const geometry::Vec3> x, std::int32_t segment,
                      std::int32_t part, const PairPlaces& places) noexcept;

/// Where a point of masses is.
inline geometry::Vec3 place_of(const GutPoint& point, std::span<const geometry::Vec3> x) {
  geometry::Vec3 place = geometry::Vec3::Zero();
  for (std::size_t i = 0; i < 3 && point.mass[i].valid(); ++i) place += point.weight[i] * x[point.mass[i]];
  return place;
}

}  // namespace omentum::physics
