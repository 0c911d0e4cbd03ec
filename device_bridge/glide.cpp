#include "device_bridge/glide.h"

#include <algorithm>

namespace omentum::device {
namespace {

Vec3 at_most(const Vec3& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vec3(v * (length / norm)) : v;
}

}  // namespace

Motion glide(const Motion& now, const Vec3& wanted, double dt_s) noexcept {
  const Vec3 velocity = at_most((wanted - now.position) / kGlide_s, kFastestGlide_m_s);
  const Vec3 reached = now.velocity + at_most(velocity - now.velocity, kGlideAcceleration_m_s2 * dt_s);
  return {now.position + reached * dt_s, reached};
}

Quat turn_towards(const Quat& now, const Quat& wanted, double fastest_rad_s, double dt_s) noexcept {
  const double angle = now.angularDistance(wanted), most = fastest_rad_s * dt_s;
  return angle <= most ? wanted : now.slerp(most / angle, wanted).normalized();
}

}  // namespace omentum::device
