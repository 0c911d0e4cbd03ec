// Where the masses of an intestine and its mesentery are.
#pragma once

#include "geometry/gut_layout.h"

#include <vector>

namespace omentum::physics {

struct GutState {
  std::vector<geometry::Vec3> x;  // [masses], in W, m
  std::vector<geometry::Vec3> v;  // [masses], in W, m/s
};

}  // namespace omentum::physics
