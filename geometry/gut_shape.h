// An intestine and its mesentery at the start of a session.
#pragma once

#include "geometry/gut_layout.h"

#include <vector>

namespace omentum::geometry {

/// A tube around an axis and a sheet behind it.
struct GutShape {
  GutLayout layout;
  std::vector<Vec3> positions;       // [masses], in W, m
  double tube_radius_m = 0;          // of the gut
  double mesentery_thickness_m = 0;  // the sheet reaches half of it to either side of its triangles
};

}  // namespace omentum::geometry
