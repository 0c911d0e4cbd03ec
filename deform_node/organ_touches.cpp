// Where organs touch one another: what OrganCollision tells of its newest tick.
#include "deform_node/organ_collision.h"

#include <cmath>
#include <utility>

namespace omentum::deform {

// Two that have not stepped push each other all that time with what they were given at its beginning.
void OrganCollision::note_touches(double tick_s) noexcept {
  for (Couple& couple : couples_) {
    couple.waited_s += tick_s;
    if (couple.waits) continue;
    couple.touches.clear();
    note_touches(couple, std::exchange(couple.waited_s, 0));
  }
}

void OrganCollision::note_touches(Couple& couple, double lasted_s) noexcept {
  for (std::size_t i = 0; i < couple.pairs.size(); ++i) {
    const Pair& pair = couple.pairs[i];
    const bool is_touching = pair.pushed > 0 || couple.of_one[i].depth_m > 0;
    if (!is_touching || couple.touches.size() == couple.touches.capacity()) continue;
    const double push_n = lasted_s > 0 ? pair.pushed * pair.weight_kg / lasted_s : 0;
    const CollisionSphere& one = couple.one->spheres[static_cast<std::size_t>(pair.one)];
    const CollisionSphere& other = couple.other->spheres[static_cast<std::size_t>(pair.other)];
    couple.touches.push_back({.one = one.centre,
                              .other = other.centre,
                              .radius_one_m = one.radius_m,
                              .radius_other_m = other.radius_m,
                              .push_n = std::isfinite(push_n) ? push_n : 0});
  }
}

OrganCollision::Met OrganCollision::met(std::size_t couple) const noexcept {
  const Couple& of = couples_[couple];
  return {.one = static_cast<std::size_t>(of.one - bodies_.data()),
          .other = static_cast<std::size_t>(of.other - bodies_.data()),
          .touches = of.touches};
}

}  // namespace omentum::deform
