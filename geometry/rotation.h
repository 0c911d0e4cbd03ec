// Rotations from directions.
#pragma once

#include "geometry/types.h"

namespace omentum::geometry {

/// The smallest rotation that turns the direction `from` into the direction `to`; neither may be zero.
/// Opposite directions are turned about some axis across. Any thread; no heap.
Eigen::Quaterniond rotation_onto(const Vec3& from, const Vec3& to) noexcept;

}  // namespace omentum::geometry
