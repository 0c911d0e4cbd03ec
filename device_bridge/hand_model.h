// A hand as a mass on a spring and a damper, whose other end is where the person wants to be.
#pragma once

#include "device_bridge/device.h"
#include "scene/scene.h"

namespace omentum::device {

/// A point that moves: m and m/s, in W.
struct Motion {
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
};

/// m a = k (target - x) + d (target' - x') + f: one step of semi-implicit Euler, velocity first. `force`: on
/// the hand, N, constant over the step. Stable for dt < 2 / (w (z + sqrt(1 + z^2))) with w = sqrt(k/m), z = d
/// / (2 sqrt(k m)).
Motion step_hand(const scene::HandSpec& hand, const Motion& now, const Motion& target, const Vec3& force,
                 double dt_s) noexcept;

/// Kinetic energy and the spring's, J.
double hand_energy(const scene::HandSpec& hand, const Motion& now, const Motion& target);

/// q_WT of an instrument whose shaft points along `shaft` (any length, not zero), without roll against W.
Quat shaft_orientation(const Vec3& shaft) noexcept;

/// The constant angular velocity, in W, rad/s, that turns `before` into `after` within dt_s the short way
/// round.
Vec3 angular_velocity(const Quat& before, const Quat& after, double dt_s) noexcept;

}  // namespace omentum::device
