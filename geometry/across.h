// What of a vector lies across a direction.
#pragma once

#include "geometry/types.h"

namespace omentum::geometry {

/// v without what of it lies along `direction`, which is a unit vector.
inline Vec3 across(const Vec3& v, const Vec3& direction) noexcept {
  return v - v.dot(direction) * direction;
}

}  // namespace omentum::geometry
