// Where a gut touches itself: what GutCollisions tells of its newest step.
#include "physics/intestine/gut_collisions.h"

namespace omentum::physics {

using geometry::Vec3;

// What springs that are stiff for the step carry on is remembered by key, and a correction of the step
// (GutSystem::move_to) has contacts of its own, whose impulses are no forces.
double GutCollisions::push_of(std::size_t contact) const noexcept {
  const Vec3& normal = contacts_[contact].normal;
  if (!is_carried_) return response_.impulse(contact).dot(normal) / step_s_;
  const Push* const push = pushes_.find(keys_[contact].one, keys_[contact].other);
  return push != nullptr ? push->impulse.dot(normal) / step_s_ : 0;
}

std::size_t GutCollisions::touches(std::span<const Vec3> x, std::span<Touch> found) const noexcept {
  const double radius_m = parts_.reach.tube_m / 2;
  std::size_t count = 0;
  for (std::size_t c = 0; c < contacts_.size() && count < found.size(); ++c) {
    if (keys_[c].one < 0) continue;  // a ball's or a wall's
    const GutContact& contact = contacts_[c];
    const Touch touch{.one = place_of(contact.one, x),
                      .other = place_of(contact.other, x),
                      .radius_one_m = radius_m,
                      .radius_other_m = contact.reach_m - radius_m,
                      .push_n = std::max(0.0, push_of(c))};
    if (touch.push_n > 0 || touch.overlap_m() > 0) found[count++] = touch;
  }
  return count;
}

}  // namespace omentum::physics
