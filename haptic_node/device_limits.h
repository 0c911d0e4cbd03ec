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

/// Between which numbers a device's limit is one.
struct LimitBounds {
  double least = 0, most = 0;
  /// False for NaN.
  bool contain(double limit) const noexcept { return limit >= least && limit <= most; }
};
/// 0 N and 0 N m are meant: nothing may be asked for. At most what a robot arm that holds an instrument
/// exerts.
inline constexpr LimitBounds kForceBounds_n{0, 1000}, kTorqueBounds_nm{0, 100};
/// From a spring that a metre's way makes a newton of, below which nothing can be felt and the contact
/// problem's numbers part too far, to stiffer than any drive.
inline constexpr LimitBounds kStiffnessBounds_n_m{1, 1e6};

/// What both allow. Where both name axes and have none in common, nothing may be asked for.
DeviceLimits stricter(const DeviceLimits& one, const DeviceLimits& other) noexcept;

/// Takes out of the wrench what the device has no motor for: forces along W's axes, torques about the tool's
/// own (pitch: T's x, yaw: T's y, roll: T's z, the shaft), the torque on its jaws. A device that names no
/// axis at all gets the whole wrench: it exerts none of it (a tracker, a recorded hand), and it is worth
/// showing.
void drop_unactuated(Wrench& wrench, std::uint32_t axes, const Eigen::Quaterniond& q_WT) noexcept;

}  // namespace omentum::haptic
