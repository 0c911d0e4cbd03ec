// What an organ of the phantom is made of: a signed distance, and how two of them flow into each other.
#pragma once

#include "geometry/types.h"

namespace omentum::phantom {

using geometry::Vec3;

/// A box that holds a shape with a margin of a few millimetres, m.
struct Extent {
  Vec3 low, high;
};

/// An organ as a function: negative inside, positive outside, zero on the surface; about the distance in
/// metres near it.
struct ImplicitShape {
  const char* name;
  double (*distance)(const Vec3& p);
  Extent extent;
};

struct Ellipsoid {
  Vec3 centre;
  Vec3 radii;  // along x, y and z
};
/// The distance to its surface, m, to first order: the value of its equation over the length of its gradient.
double ellipsoid_distance(const Ellipsoid& e, const Vec3& p);

/// The smaller of two distances, blended by a parabola where they differ by less than `width` (m, above 0).
double blended_min(double a, double b, double width);
/// The larger one, likewise.
double blended_max(double a, double b, double width);

}  // namespace omentum::phantom
