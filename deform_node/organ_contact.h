// How organs meet one another: as spheres (Raghupathi 2004, section 6), whatever moves them.
#pragma once

#include "geometry/types.h"

#include <cstdint>

namespace omentum::deform {

/// A part of an organ as other organs meet it.
struct CollisionSphere {
  geometry::Vec3 centre = geometry::Vec3::Zero();    // in W, m
  geometry::Vec3 velocity = geometry::Vec3::Zero();  // in W, m/s
  double radius_m = 0;
  double mass_kg = 0;  // infinite: it does not yield
};

/// One of an organ's spheres overlaps one of another organ's.
struct OrganContact {
  std::int32_t sphere = 0;                           // of this organ
  geometry::Vec3 normal = geometry::Vec3::UnitZ();   // from the other sphere to this one, in W, unit
  double depth_m = 0;                                // of the overlap
  geometry::Vec3 velocity = geometry::Vec3::Zero();  // of the other sphere, in W, m/s
  double share = 1;  // of the correction, this organ's: m_other / (m_other + m_own), so that momentum stays
};

}  // namespace omentum::deform
