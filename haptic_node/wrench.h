// Force and torque on a hand.
#pragma once

#include "geometry/types.h"

namespace omentum::haptic {

using geometry::Vec3;

struct Wrench {
  Vec3 force = Vec3::Zero();   // on the hand at the tip, in W, N
  Vec3 torque = Vec3::Zero();  // on the hand about the tip, in W, N m
};

inline bool is_finite(const Wrench& wrench) noexcept {
  return wrench.force.allFinite() && wrench.torque.allFinite();
}

}  // namespace omentum::haptic
