// How far the tissue of an organ that moves can get.
#pragma once

#include "geometry/boxes.h"

namespace omentum::node {

/// What fell so many diagonals of the organ is out of everybody's sight: deform_node drops it, and of a node
/// that is farther from its rest nobody tells.
inline constexpr double kReachDiagonals = 2;

/// The same in metres; `rest`: the nodes of the whole organ, m.
inline double reach_m(std::span<const geometry::Vec3> rest) {
  return kReachDiagonals * geometry::diagonal_around(rest);
}

}  // namespace omentum::node
