// What a trocar leaves of an instrument's pose.
#pragma once

#include "geometry/types.h"

#include <Eigen/Geometry>

namespace omentum::geometry {

/// An instrument's orientation q_WT with the five degrees of freedom that a trocar leaves (Cotin 1999,
/// section 6): the tip p_WT stays, the shaft (z of T, towards the handle) passes the pivot, roll about the
/// shaft is the measured one: the smallest turn adds none. Three of the freedoms (the pivot's two angles and
/// insertion) are the tip's position, the fourth is roll, the fifth the grip. A tip that was pulled out
/// beyond the pivot keeps its shaft on the line through it. Within 5 mm of the pivot the line has no
/// direction: the measured one holds there. p_WT, pivot in m. Any thread; no heap.
Eigen::Quaterniond through_trocar(const Vec3& p_WT, const Eigen::Quaterniond& q_WT,
                                  const Vec3& pivot) noexcept;

/// How far the shaft's axis passes the pivot, m.
double trocar_miss_m(const Vec3& p_WT, const Eigen::Quaterniond& q_WT, const Vec3& pivot) noexcept;

/// The orientation without roll of an instrument whose shaft points along `shaft` (towards the handle, any
/// length, not zero): x of T is level, y of T is as far up as the shaft leaves it. A shaft that stands
/// upright has no such side: x stays W's.
Eigen::Quaterniond level_orientation(const Vec3& shaft) noexcept;

}  // namespace omentum::geometry
