// What the tests of the tensors' books and of their copies in float are about.
#pragma once

#include "physics/material.h"

namespace omentum::physics {

inline const Material kMaterial{5000, 0.45, 1000};
inline constexpr double kFloatRounding = 2e-6;  ///< relative: sums of some twenty products in float

}  // namespace omentum::physics
