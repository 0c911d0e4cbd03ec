#include "haptic_node/device_limits.h"

#include <algorithm>

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

DeviceLimits stricter(const DeviceLimits& one, const DeviceLimits& other) noexcept {
  DeviceLimits both{std::min(one.max_force_n, other.max_force_n),
                    std::min(one.max_torque_nm, other.max_torque_nm),
                    std::min(one.max_stiffness_n_m, other.max_stiffness_n_m), 0};
  const bool both_name_axes = one.actuated_axes != 0 && other.actuated_axes != 0;
  both.actuated_axes =
      both_name_axes ? one.actuated_axes & other.actuated_axes : one.actuated_axes | other.actuated_axes;
  // no axis at all would mean the whole wrench
  if (both_name_axes && both.actuated_axes == 0) both.max_force_n = both.max_torque_nm = 0;
  return both;
}

void drop_unactuated(Wrench& wrench, std::uint32_t axes, const Eigen::Quaterniond& q_WT) noexcept {
  static_assert(msg::AXIS_Z == msg::AXIS_X << 2 && msg::AXIS_ROLL == msg::AXIS_PITCH << 2);
  constexpr std::uint32_t kTorques = msg::AXIS_PITCH | msg::AXIS_YAW | msg::AXIS_ROLL;
  if (axes == 0) return;
  wrench.force = along_axes(wrench.force, axes, msg::AXIS_X);
  if (!(axes & msg::AXIS_GRIP)) wrench.grip_torque = 0;
  // the rotation there and back would only add rounding where nothing is dropped
  if ((axes & kTorques) == kTorques) return;
  wrench.torque = q_WT * along_axes(q_WT.conjugate() * wrench.torque, axes, msg::AXIS_PITCH);
}

}  // namespace omentum::haptic
