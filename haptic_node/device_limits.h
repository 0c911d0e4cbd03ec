// What a device may be asked for.
#pragma once

#include "haptic_node/wrench.h"
#include "transport/messages.h"

#include <Eigen/Geometry>

#include <limits>

namespace omentum::haptic {

/// A device that does not say how stiff a wall it renders gets this one, N/m: what a light desktop device
/// with 1 N s/m of damping of its own holds at 1 kHz (k < 2 b / T, Colgate and Schenkel 1997). Organs are ten
/// times softer; their supports are not.
inline constexpr double kUsualStiffness_n_m = 2000;

/// DeviceInfo as far as forces go. The defaults are a device that did not say.
struct DeviceLimits {
  double max_force_n = std::numeric_limits<double>::infinity();
  double max_torque_nm = std::numeric_limits<double>::infinity();
  double max_stiffness_n_m = kUsualStiffness_n_m;
  std::uint32_t actuated_axes = 0;  // msg::AXIS_* bits
};

/// A limit of 0 N or 0 N m is meant: nothing may be asked for. What is no limit (NaN, infinite, negative; a
/// stiffness of 0, which nothing can be felt with) is left at its default, and `sound` is false.
struct ReadLimits {
  DeviceLimits limits;
  bool sound = true;
};
ReadLimits read_limits(const msg::DeviceInfo& info) noexcept;

/// Takes out of the wrench what the device has no motor for: forces along W's axes, torques about the tool's
/// own (pitch: T's x, yaw: T's y, roll: T's z, the shaft). A device that names no axis at all gets the whole
/// wrench: it exerts none of it (a tracker, a recorded hand), and it is worth showing.
void drop_unactuated(Wrench& wrench, std::uint32_t axes, const Eigen::Quaterniond& q_WT) noexcept;

}  // namespace omentum::haptic
