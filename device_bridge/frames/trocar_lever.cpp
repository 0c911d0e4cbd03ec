#include "device_bridge/frames/trocar_lever.h"

#include "geometry/rotation.h"

#include <algorithm>

namespace omentum::device {
namespace {

// Cosine of the angle between the handle's own axis and the shaft, below which nobody holds a handle; at -1
// the smallest turn of one onto the other is any.
constexpr double kLeastAgreement = -0.5;

// The shaft of one handle's pose.
struct Shaft {
  Shaft(const TrocarLever& lever, const Measurement& handle)
      : outside_m((handle.position - lever.pivot).norm()),
        along((handle.position - lever.pivot) / outside_m),
        held(handle.orientation * Vec3::UnitZ()),
        across_ratio(1 - lever.length_m / outside_m) {}

  // What a velocity of the handle is at the tip. Symmetric, so that it is its own transpose.
  Vec3 levered(const Vec3& v) const {
    const Vec3 insertion = along.dot(v) * along;
    return insertion + across_ratio * (v - insertion);
  }
  double agreement() const { return held.dot(along); }

  double outside_m;     // r
  Vec3 along, held;     // z and m, unit
  double across_ratio;  // 1 - L / r
};

}  // namespace

bool goes_through(const TrocarLever& lever, const Measurement& handle) noexcept {
  if (!((handle.position - lever.pivot).norm() >= lever.least_outside_m)) return false;
  return Shaft(lever, handle).agreement() >= kLeastAgreement;
}

Measurement at_tip(const TrocarLever& lever, const Measurement& handle) noexcept {
  const Shaft shaft(lever, handle);
  const Vec3 swing = shaft.along.cross(handle.linear_velocity) / shaft.outside_m;
  const double spin = (handle.angular_velocity.dot(shaft.held + shaft.along) - shaft.held.dot(swing)) /
                      (1 + shaft.agreement());
  Measurement tip = handle;
  tip.position = handle.position - lever.length_m * shaft.along;
  tip.orientation = (geometry::rotation_onto(shaft.held, shaft.along) * handle.orientation).normalized();
  tip.linear_velocity = shaft.levered(handle.linear_velocity);
  tip.angular_velocity = swing + spin * shaft.along;
  return tip;
}

Wrench at_handle(const TrocarLever& lever, const Measurement& handle, const Wrench& at_tip) noexcept {
  const Shaft shaft(lever, handle);
  const double roll_torque = at_tip.torque.dot(shaft.along) / (1 + shaft.agreement());
  const Vec3 swing_force = (at_tip.torque - roll_torque * shaft.held).cross(shaft.along) / shaft.outside_m;
  return {shaft.levered(at_tip.force) + swing_force, roll_torque * (shaft.held + shaft.along),
          at_tip.grip_torque};
}

Measurement at_handle(const TrocarLever& lever, const Measurement& tip) noexcept {
  const Vec3 along = (lever.pivot - tip.position).normalized();
  Measurement handle = tip;
  handle.position += lever.length_m * along;
  const double outside_m = (handle.position - lever.pivot).dot(along);
  const Vec3 insertion = along.dot(tip.linear_velocity) * along;
  handle.linear_velocity = insertion + (tip.linear_velocity - insertion) / (1 - lever.length_m / outside_m);
  return handle;
}

double largest_ratio(const TrocarLever& lever) noexcept {
  return std::max(1.0, lever.length_m / lever.least_outside_m - 1);
}

}  // namespace omentum::device
