// Two round parts of tissue that touch, as others may want to see it.
#pragma once

#include "geometry/types.h"

namespace omentum::physics {

/// `one` and `other` are the middles of both parts, in W, m: overlap_m() below 0 is the gap between them.
/// `push_n`: with which each pushes the other away along the line between the middles, N, >= 0, over the
/// newest step; what rubs is not in it.
struct Touch {
  geometry::Vec3 one = geometry::Vec3::Zero(), other = geometry::Vec3::Zero();
  double radius_one_m = 0, radius_other_m = 0;
  double push_n = 0;

  double overlap_m() const { return radius_one_m + radius_other_m - (one - other).norm(); }
};

}  // namespace omentum::physics
