#include "haptic_node/tool_kinematics.h"

#include "geometry/rotation.h"

namespace omentum::haptic {
namespace {

// Closer to the pivot than a shaft's thickness its direction is noise, m.
constexpr double kMinInsertion_m = 0.005;

}  // namespace

ToolFrame through_trocar(const ToolFrame& measured, const Vec3& pivot) noexcept {
  const Vec3 measured_z = measured.q_WT * Vec3::UnitZ();
  const Vec3 to_pivot = pivot - measured.p_WT;
  const double insertion = to_pivot.norm();
  if (insertion < kMinInsertion_m) return measured;
  const Vec3 z = (to_pivot.dot(measured_z) >= 0 ? 1 : -1) / insertion * to_pivot;
  // the smallest turn that puts the shaft through the pivot adds no roll
  return {measured.p_WT, (geometry::rotation_onto(measured_z, z) * measured.q_WT).normalized()};
}

Vec3 rotation_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) noexcept {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  return turn.angle() * turn.axis();
}

}  // namespace omentum::haptic
