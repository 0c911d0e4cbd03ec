#include "deform_node/organ_contact.h"

#include <algorithm>

namespace omentum::deform {

using geometry::Vec3;

namespace {

// Of an overlap, in each second: below one over the longest step (60 Hz), or what parts would fly on.
constexpr double kParting_per_s = 50;
// So deep organs lie in one another: what parted wholly would fall again, and tremble.
constexpr double kTouch_m = 0.001;
// However deep: organs that a scene begins with in one another part, and are not shot away.
constexpr double kFastest_m_s = 0.2;

}  // namespace

double lacking_speed(const OrganContact& contact, const Vec3& own_velocity) noexcept {
  const double wanted_m_s = std::min(kParting_per_s * (contact.depth_m - kTouch_m), kFastest_m_s);
  return wanted_m_s - (own_velocity - contact.velocity).dot(contact.normal);
}

Vec3 answer(const OrganContact& contact, const Vec3& own_velocity) noexcept {
  if (contact.rubs_on) return contact.share * (contact.push_m_s * contact.normal + contact.rub_m_s);
  const Vec3 relative = own_velocity - contact.velocity;
  const Vec3 sliding = relative - relative.dot(contact.normal) * contact.normal;
  const double sliding_m_s = sliding.norm(), most_m_s = kFriction * std::max(0.0, contact.push_m_s);
  const double rubbed = sliding_m_s > 0 ? std::min(1.0, most_m_s / sliding_m_s) : 0;
  return contact.share * (contact.push_m_s * contact.normal - rubbed * sliding);
}

}  // namespace omentum::deform
