// The distances that a gut's collisions ask for ten thousand times in a second.
#pragma once

#include "geometry/types.h"

#include <array>

namespace omentum::physics {

/// Closest points of a segment and another part of a gut.
struct PairPlaces {
  double s = 0;                                    // along the segment, 0 to 1
  geometry::Vec3 other = geometry::Vec3::UnitX();  // weights of the part's corners; a segment has two
  double distance_m = 0;
};

/// Of two segments p -> q and a -> b; where they lie side by side, the middle of what they have beside each
/// other, so that a contact there does not jump from end to end.
PairPlaces between_segments(const geometry::Vec3& p, const geometry::Vec3& q, const geometry::Vec3& a,
                            const geometry::Vec3& b) noexcept;

/// Of a segment p -> q and a triangle: 0 where they cross. Exact up to `farthest_m`; of what is farther a
/// lower bound that is farther too. geometry/segment_points.h answers the same in a plainer way; this one
/// forms the products of all edges once, which takes a third of the time.
PairPlaces between_segment_and_triangle(const geometry::Vec3& p, const geometry::Vec3& q,
                                        const std::array<const geometry::Vec3*, 3>& corners,
                                        double farthest_m) noexcept;

}  // namespace omentum::physics
