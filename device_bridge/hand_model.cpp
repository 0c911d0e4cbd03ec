#include "device_bridge/hand_model.h"

#include "geometry/rotation.h"

namespace omentum::device {

Motion step_hand(const scene::HandSpec& hand, const Motion& now, const Motion& target, const Vec3& force,
                 double dt_s) noexcept {
  const Vec3 acceleration = (hand.stiffness_n_m * (target.position - now.position) +
                             hand.damping_n_s_m * (target.velocity - now.velocity) + force) /
                            hand.mass_kg;
  const Vec3 velocity = now.velocity + acceleration * dt_s;
  return {now.position + velocity * dt_s, velocity};
}

double hand_energy(const scene::HandSpec& hand, const Motion& now, const Motion& target) {
  return 0.5 * hand.mass_kg * now.velocity.squaredNorm() +
         0.5 * hand.stiffness_n_m * (now.position - target.position).squaredNorm();
}

Quat shaft_orientation(const Vec3& shaft) noexcept {
  return geometry::rotation_onto(Vec3::UnitZ(), shaft);
}

Vec3 angular_velocity(const Quat& before, const Quat& after, double dt_s) noexcept {
  const Eigen::AngleAxisd turn(after * before.conjugate());
  // Eigen's angle lies in [0, 2 pi) for either sign of the quaternion
  const double angle = turn.angle() > M_PI ? turn.angle() - 2 * M_PI : turn.angle();
  return turn.axis() * (angle / dt_s);
}

}  // namespace omentum::device
