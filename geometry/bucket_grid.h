// Cotin 1999, section 5: a hash of parallelepiped buckets over a deforming surface.
#pragma once

#include "geometry/surface.h"

namespace omentum::geometry {

/// Triangles of a deforming surface, binned by their bounding boxes into hashed cubic buckets. The box is
/// inflated by a slack, so that a triangle is binned again only when it has left its inflated box. The paper
/// hashes nodes and looks at the 26 neighbours; binning triangles finds every bucket a fast segment
/// crosses as well (DESIGN 3: the paper's search misses those).
///
/// No allocation after construction. One thread at a time.
class BucketGrid {
 public:
  /// Bucket edge: about the mean triangle edge. `slack_m`: 0 < slack < bucket edge.
  BucketGrid(const Surface& surface, std::span<const Vec3> positions, double slack_m);

  /// Tells where one triangle's vertices are now. Cheap when it stayed inside its inflated box.
  void update(TriangleId triangle, const Vec3& a, const Vec3& b, const Vec3& c);

  /// Calls visit(TriangleId) once for each triangle whose inflated box shares a bucket with one that
  /// the segment p -> q (inflated by radius_m) crosses. Exact positions are the caller's to test.
  template <class Visit>
  void visit_segment(const Vec3& p, const Vec3& q, double radius_m, Visit&& visit);

  /// The paper's three-level search: the nearest node among the 27 buckets around p (growing shells
  /// until one is found), then the closest point on the triangles of its fan. `positions`: [S], m.
  struct Nearest { TriangleId triangle; Vec3 barycentric; double squared_distance; };
  // see bucket_grid.cpp for the exact signature chosen by its implementation
};

}  // namespace omentum::geometry
