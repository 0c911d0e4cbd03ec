// Spheres that cover the surface of a mesh from inside: what other bodies meet of it.
#pragma once

#include "geometry/surface.h"

#include <span>
#include <vector>

namespace omentum::geometry {

/// A sphere below a point of the surface. It moves with the tetrahedron that its centre lies in.
struct CoverSphere {
  Vec3 centre = Vec3::Zero();  // at rest, m
  double radius_m = 0;
  TetId tetrahedron{};
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();  // barycentric coordinates of the centre there
  TriangleId below{};                                 // of the surface ...
  Vec3 place = Vec3::Zero();                          // ... barycentric coordinates of the point
};

struct SphereCover {
  std::vector<CoverSphere> spheres;
  double spacing_m = 0;  // no sphere is larger, nor stands out farther
};

/// Every triangle, in pieces smaller than the spacing, lies in a sphere whole: the surface has no gap. Where
/// the body is thick, a sphere stands out by a third of the spacing; where it is thin, its centre is as deep
/// as there is room. A triangle without area gets none: its neighbours have it. About `about` spheres, from
/// the mesh alone: the same on every machine. Looks at the tetrahedra that begin near a sphere along x only.
SphereCover cover_with_spheres(const TetraMesh& mesh, const Surface& surface, double about = 150);

}  // namespace omentum::geometry
