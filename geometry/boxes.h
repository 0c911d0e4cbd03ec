// Boxes along the axes.
#pragma once

#include "geometry/types.h"

#include <span>

namespace omentum::geometry {

/// Of the box around `points`, in their unit; 0 without any.
inline double diagonal_around(std::span<const Vec3> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Inside the box between two opposite corners, whichever they are, or on its faces.
inline bool in_box(const Vec3& p, const Vec3& a, const Vec3& b) {
  return (p.array() >= a.array().min(b.array())).all() && (p.array() <= a.array().max(b.array())).all();
}

}  // namespace omentum::geometry
