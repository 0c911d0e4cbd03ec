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

/// So near spheres count as met: organs at 0.5 m/s come no nearer in a step of 0.01 s, m.
inline constexpr double kNear_m = 0.005;

/// One of an organ's spheres overlaps one of another organ's, or nearly so.
struct OrganContact {
  std::int32_t sphere = 0;                           // of this organ
  geometry::Vec3 normal = geometry::Vec3::UnitZ();   // from the other sphere to this one, in W, unit
  double depth_m = 0;                                // of the overlap; negative: the gap
  geometry::Vec3 velocity = geometry::Vec3::Zero();  // of the other sphere, in W, m/s
  // How much of the correction this organ makes: m_other / (m_other + m_own), so that momentum stays, times
  // what OrganCollision found to be good for all contacts of the two organs.
  double share = 1;
  double push_m_s = 0;  // how much faster both are to part; below 0: less, where they were pushed too much
  // Where pushes go on from tick to tick (OrganCollision), so does what rubs: by how much the spheres'
  // sliding is to change, m/s, in W. Elsewhere each push rubs anew.
  bool rubs_on = false;
  geometry::Vec3 rub_m_s = geometry::Vec3::Zero();
  bool goes_on = false;  // a push of the tick before, with which this one begins
};

/// Wet serous tissue on the same (Coulomb).
inline constexpr double kFriction = 0.2;

/// How much faster both have to part than they do, m/s; below 0: fast enough. They part the faster the deeper
/// they overlap, down to a depth at which they stay in touch.
double lacking_speed(const OrganContact& contact, const geometry::Vec3& own_velocity) noexcept;

/// What one contact adds to the velocity of this organ's sphere, m/s, in W: the push, and what rubs against
/// sliding (Coulomb). Times the spheres' masses it is opposite and equal on both sides: `own_velocity` is the
/// sphere's as the organ offered it.
geometry::Vec3 answer(const OrganContact& contact, const geometry::Vec3& own_velocity) noexcept;

}  // namespace omentum::deform
