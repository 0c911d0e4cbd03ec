// Hands that move anyhow, and how well a mapping keeps their work.
#pragma once

#include "device_bridge/frames/hand_mapping.h"

#include <random>

namespace omentum::device::test {

class RandomHand {
 public:
  explicit RandomHand(unsigned seed) : random_(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  Vec3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  Quat turn() { return Quat(Eigen::Vector4d::Random().normalized()); }
  Wrench wrench() { return {vector(5), vector(0.2), number(-0.1, 0.1)}; }

  BaseFrame base() { return {turn(), vector(0.3), number(0.2, 3)}; }
  TrocarLever lever() { return {vector(0.2), 0.3, 0.1}; }

  /// Near `about`, held by whatever orientation.
  Measurement hand(const Vec3& about) {
    Measurement hand;
    hand.valid = true;
    hand.position = about + vector(0.05);
    hand.orientation = turn();
    hand.linear_velocity = vector(0.3);
    hand.angular_velocity = vector(2);
    return hand;
  }
  /// A handle of `lever`, whose own axis is up to 1 rad off the shaft.
  Measurement handle(const TrocarLever& lever) {
    const Vec3 along = vector(1).normalized();
    Measurement handle = hand(Vec3::Zero());
    handle.position = lever.pivot + number(lever.least_outside_m, lever.length_m) * along;
    const Quat pointed =
        Quat::FromTwoVectors(Vec3::UnitZ(), along) * Eigen::AngleAxisd(number(-3, 3), Vec3::UnitZ());
    handle.orientation = Eigen::AngleAxisd(number(0, 1), vector(1).normalized()) * pointed;
    return handle;
  }

 private:
  std::mt19937 random_;
};

/// The same hand a moment later, as its velocities say.
inline Measurement moved(const Measurement& hand, double dt_s) {
  Measurement later = hand;
  later.position += dt_s * hand.linear_velocity;
  const double angle = hand.angular_velocity.norm() * dt_s;
  if (angle != 0)
    later.orientation = Eigen::AngleAxisd(angle, hand.angular_velocity.normalized()) * hand.orientation;
  return later;
}

inline double power_w(const Wrench& wrench, const Measurement& moving) {
  return wrench.force.dot(moving.linear_velocity) + wrench.torque.dot(moving.angular_velocity);
}

/// The turn between two orientations, rad, as a vector.
inline Vec3 turn_between(const Quat& from, const Quat& to) {
  const Eigen::AngleAxisd turn((to * from.conjugate()).normalized());
  const double angle = turn.angle() > M_PI ? turn.angle() - 2 * M_PI : turn.angle();
  return angle * turn.axis();
}

}  // namespace omentum::device::test
