// How a material point goes over a surface towards a place.
#pragma once

#include "geometry/closest_points.h"
#include "geometry/surface.h"

namespace omentum::haptic {

/// Triangles that a sliding contact may cross in one tick; a fast instrument crosses three.
inline constexpr int kMaxSlideSteps = 64;
/// Barycentric coordinates below this lie on the opposite edge.
inline constexpr double kOnEdge = 1e-12;
/// How far the rims of two skins that are one body may lie apart under a dent, m.
inline constexpr double kSeam_m = 2e-3;

/// Where going from triangle to triangle ends, as long as the next one is nearer to p. `closest_on`: the
/// TrianglePoint of a triangle that is nearest to a place.
template <class ClosestOn>
std::pair<geometry::TriangleId, geometry::TrianglePoint> walk_to(const geometry::Surface& surface,
                                                                 geometry::TriangleId from,
                                                                 const geometry::Vec3& p,
                                                                 ClosestOn&& closest_on) {
  geometry::TrianglePoint best = closest_on(from, p);
  geometry::TriangleId here = from;
  for (int step = 0; step < kMaxSlideSteps; ++step) {
    const geometry::TriangleId origin = here;
    // only where the closest point lies on an edge or a vertex can a neighbour be nearer
    const geometry::Triangle& t = surface.triangles[origin];
    const geometry::Vec3 k = best.barycentric;
    if (k.minCoeff() > kOnEdge) break;
    for (int v = 0; v < 3; ++v) {
      if (k[v] <= kOnEdge) continue;
      for (const geometry::TriangleId next : surface.triangles_of(t[static_cast<std::size_t>(v)])) {
        const geometry::TrianglePoint point = closest_on(next, p);
        if (point.squared_distance < best.squared_distance) best = point, here = next;
      }
    }
    if (here == origin) break;
  }
  return {here, best};
}

/// Two skins may meet that share no nodes, as those of a hybrid organ's parts: a triangle that lies at a
/// rim's point `rim` and is nearer to p than that; invalid: none.
template <class ClosestOn>
geometry::TriangleId across_seam(const geometry::Surface& surface, const geometry::Vec3& rim,
                                 const geometry::Vec3& p, ClosestOn&& closest_on) {
  geometry::TriangleId found;
  double least = (p - rim).squaredNorm();
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const geometry::TriangleId t(i);
    if (closest_on(t, rim).squared_distance > kSeam_m * kSeam_m) continue;
    const double squared = closest_on(t, p).squared_distance;
    if (squared < least) least = squared, found = t;
  }
  return found;
}

}  // namespace omentum::haptic
