// What the tests of the tissue's laws are about, and how well differences tell a derivative there.
#pragma once

#include "physics/material.h"

namespace omentum::physics {

inline const Material kTissue{5000, 0.4, 1000};
inline constexpr double kEdge = 0.01;  ///< m, of the boxes' cubes
inline constexpr double kStep = 1e-5 * kEdge;
/// What central differences with kStep leave: 1e-10 + 1e-16 / 1e-5, with room.
inline constexpr double kDifferences = 1e-7;

}  // namespace omentum::physics
