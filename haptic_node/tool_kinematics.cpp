#include "haptic_node/tool_kinematics.h"

#include "geometry/trocar.h"

namespace omentum::haptic {

ToolFrame through_trocar(const ToolFrame& measured, const Vec3& pivot) noexcept {
  return {measured.p_WT, geometry::through_trocar(measured.p_WT, measured.q_WT, pivot)};
}

Vec3 rotation_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) noexcept {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  return turn.angle() * turn.axis();
}

}  // namespace omentum::haptic
