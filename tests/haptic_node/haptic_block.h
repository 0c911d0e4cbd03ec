// The scene that haptic_node is tested in, and how its block is pressed.
#pragma once

#include "transport/messages.h"

#include "tests/support/block_scene.h"

namespace omentum::haptic_test {

using geometry::Vec3;

/// Forces leave as doubles; contacts' forces are summed again in the tests.
inline constexpr double kRelative = 1e-9;
/// Of the tip, m: over the block, and 6 mm in it.
inline const Vec3 kAbove{0.048, 0.053, 0.103}, kPressed{0.048, 0.053, 0.094};

/// A probe (tool 0) and a grasper (tool 3).
inline test::BlockScene block_scene() {
  return test::BlockScene(
      6,
      "[[tools]]\nid = 0\nname = \"probe\"\nshape = \"probe\"\npoints = [[0,0,0], [0.003,0,0.001]]\n"
      "[[tools]]\nid = 3\nname = \"grasper\"\nshape = \"grasper\"\npoints = [[0,0,0]]\n");
}

inline Vec3 vector(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace omentum::haptic_test
