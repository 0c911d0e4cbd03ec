// Force and torques on a hand.
#pragma once

#include "geometry/types.h"

#include <cmath>

namespace omentum::haptic {

using geometry::Vec3;

struct Wrench {
  Vec3 force = Vec3::Zero();   // on the hand at the tip, in W, N
  Vec3 torque = Vec3::Zero();  // on the hand about the tip, in W, N m
  double grip_torque = 0;      // on the jaws, N m, positive opens
};

inline bool is_finite(const Wrench& wrench) noexcept {
  return wrench.force.allFinite() && wrench.torque.allFinite() && std::isfinite(wrench.grip_torque);
}

}  // namespace omentum::haptic
