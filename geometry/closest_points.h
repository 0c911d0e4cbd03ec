// Closest points and intersections between points, segments and triangles.
#pragma once

#include "geometry/types.h"

#include <optional>

namespace omentum::geometry {

/// A point of a triangle: barycentric coordinates (sum 1, each >= 0) and squared distance, m^2.
struct TrianglePoint {
  Vec3 barycentric;
  double squared_distance;
};

TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Where the segment p -> q meets the triangle: parameter along it in [0,1] and barycentrics.
struct SegmentHit {
  double parameter;
  Vec3 barycentric;
};

/// Watertight: a segment through a shared edge or vertex hits at least one of the triangles there.
/// Coplanar segments give no hit. Both directions count; the caller looks at the normal.
std::optional<SegmentHit> intersect_segment_triangle(const Vec3& p, const Vec3& q, const Vec3& a,
                                                     const Vec3& b, const Vec3& c);

}  // namespace omentum::geometry
