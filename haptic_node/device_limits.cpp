#include "haptic_node/device_limits.h"

#include <cmath>

namespace omentum::haptic {
namespace {

// The vector with those components left whose bit is up; `first`: the bit of the x component, y and z follow.
Vec3 along_axes(const Vec3& v, std::uint32_t axes, std::uint32_t first) {
  Vec3 kept = v;
  for (int i = 0; i < 3; ++i) {
    if (!(axes & first << i)) kept[i] = 0;
  }
  return kept;
}

}  // namespace

ReadLimits read_limits(const msg::DeviceInfo& info) noexcept {
  ReadLimits read;
  const auto take = [&read](double given, bool possible, double& limit) {
    if (std::isfinite(given) && possible) {
      limit = given;
    } else {
      read.sound = false;
    }
  };
  take(info.max_force_n, info.max_force_n >= 0, read.limits.max_force_n);
  take(info.max_torque_nm, info.max_torque_nm >= 0, read.limits.max_torque_nm);
  take(info.max_stiffness_n_m, info.max_stiffness_n_m > 0, read.limits.max_stiffness_n_m);
  read.limits.actuated_axes = info.actuated_axes;
  return read;
}

void drop_unactuated(Wrench& wrench, std::uint32_t axes, const Eigen::Quaterniond& q_WT) noexcept {
  static_assert(msg::AXIS_Z == msg::AXIS_X << 2 && msg::AXIS_ROLL == msg::AXIS_PITCH << 2);
  constexpr std::uint32_t kTorques = msg::AXIS_PITCH | msg::AXIS_YAW | msg::AXIS_ROLL;
  if (axes == 0) return;
  wrench.force = along_axes(wrench.force, axes, msg::AXIS_X);
  // the rotation there and back would only add rounding where nothing is dropped
  if ((axes & kTorques) == kTorques) return;
  wrench.torque = q_WT * along_axes(q_WT.conjugate() * wrench.torque, axes, msg::AXIS_PITCH);
}

}  // namespace omentum::haptic
