// A place where two parts of an intestine, or one and something else, are near each other.
#pragma once

#include "geometry/gut_layout.h"

#include <array>

namespace omentum::physics {

/// A point on a segment or triangle of masses, by barycentric weights; what is not used has no mass and
/// weight 0.
struct GutPoint {
  std::array<geometry::MassId, 3> mass{};
  std::array<double, 3> weight{};
};

/// Two closest points whose distance is below `reach_m`, the sum of both radii: they overlap, and the
/// response takes them apart along `normal` (Raghupathi 2004, eqs 2 to 9). Where `other` has no masses the
/// other side is not of this body: it stands at `place` and goes with `velocity`, whatever happens.
struct GutContact {
  GutPoint one, other;
  geometry::Vec3 place = geometry::Vec3::Zero();     // of the other side without masses, in W, m
  geometry::Vec3 velocity = geometry::Vec3::Zero();  // likewise, in W, m/s
  geometry::Vec3 normal = geometry::Vec3::UnitZ();   // from the other point to the one, in W, unit
  double reach_m = 0;
};

}  // namespace omentum::physics
