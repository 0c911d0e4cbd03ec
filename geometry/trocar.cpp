#include "geometry/trocar.h"

#include "geometry/rotation.h"

namespace omentum::geometry {
namespace {

// Closer to the pivot than a shaft's thickness its direction is noise, m.
constexpr double kMinInsertion_m = 0.005;
// Of a unit shaft's level part: below it, a thousandth of a radian, it stands upright.
constexpr double kUpright = 1e-3;

}  // namespace

Eigen::Quaterniond through_trocar(const Vec3& p_WT, const Eigen::Quaterniond& q_WT,
                                  const Vec3& pivot) noexcept {
  const Vec3 measured_z = q_WT * Vec3::UnitZ();
  const Vec3 to_pivot = pivot - p_WT;
  const double insertion = to_pivot.norm();
  if (insertion < kMinInsertion_m) return q_WT;
  const Vec3 z = (to_pivot.dot(measured_z) >= 0 ? 1 : -1) / insertion * to_pivot;
  return (rotation_onto(measured_z, z) * q_WT).normalized();
}

double trocar_miss_m(const Vec3& p_WT, const Eigen::Quaterniond& q_WT, const Vec3& pivot) noexcept {
  return (pivot - p_WT).cross(q_WT * Vec3::UnitZ()).norm();
}

Eigen::Quaterniond level_orientation(const Vec3& shaft) noexcept {
  const Vec3 z = shaft.normalized();
  const Vec3 level = Vec3::UnitZ().cross(z);
  const Vec3 x =
      level.norm() > kUpright ? level.normalized() : Vec3((Vec3::UnitX() - z.x() * z).normalized());
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return Eigen::Quaterniond(axes);
}

}  // namespace omentum::geometry
