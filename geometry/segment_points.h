// Closest points of two segments, and of a segment and a triangle.
#pragma once

#include "geometry/types.h"

namespace omentum::geometry {

/// Of the segments p1 -> q1 and p2 -> q2: parameters along them in [0,1], and squared distance, m^2.
struct SegmentPair {
  double s, t;
  double squared_distance;
};

/// The nearest two points (Raghupathi 2004, section 4.1; Ericson 2005, "Real-Time Collision Detection",
/// 5.1.9). Parallel segments have many: one of them is found. A segment may be a point.
SegmentPair closest_points_of_segments(const Vec3& p1, const Vec3& q1, const Vec3& p2,
                                       const Vec3& q2) noexcept;

/// Of the segment p -> q and a triangle: parameter along the segment in [0,1], barycentric coordinates (sum
/// 1, each >= 0), and squared distance, m^2: 0 where they cross.
struct SegmentTrianglePair {
  double s;
  Vec3 barycentric;
  double squared_distance;
};

/// The nearest two points: where the segment passes through the triangle, or else an end of it over the
/// triangle, or it and an edge. Segment and triangle may be without length and area.
SegmentTrianglePair closest_points_of_segment_and_triangle(const Vec3& p, const Vec3& q, const Vec3& a,
                                                           const Vec3& b, const Vec3& c) noexcept;

}  // namespace omentum::geometry
