#include "deform_node/touching_parts.h"

#include <algorithm>

namespace omentum::deform {

void TouchingParts::take(const OrganGroup& organs) noexcept {
  count_ = 0;
  for (std::size_t i = 0; i < organs.organs().size(); ++i) {
    const std::size_t found = organs.organs()[i].model->touches_itself(of_organ_);
    add(i, i, std::span(of_organ_).first(found));
  }
  const OrganCollision& collision = organs.collision();
  for (std::size_t c = 0; c < collision.couple_count(); ++c) {
    const OrganCollision::Met met = collision.met(c);
    add(met.one, met.other, met.touches);
  }
}

void TouchingParts::add(std::size_t one, std::size_t other,
                        std::span<const physics::Touch> touches) noexcept {
  for (const physics::Touch& touch : touches.first(std::min(touches.size(), parts_.size() - count_)))
    parts_[count_++] = {static_cast<std::uint32_t>(one), static_cast<std::uint32_t>(other), touch};
}

std::span<const TouchingPart> hardest_pushed(std::span<TouchingPart> parts) noexcept {
  if (parts.size() <= msg::MAX_TOUCHING_PAIRS) return parts;
  const auto push = [](const TouchingPart& part) { return part.touch.push_n; };
  std::ranges::nth_element(parts, parts.begin() + msg::MAX_TOUCHING_PAIRS, std::ranges::greater{}, push);
  return parts.first(msg::MAX_TOUCHING_PAIRS);
}

msg::TouchingPair to_message(const TouchingPart& part) noexcept {
  const Eigen::Vector3f one = part.touch.one.cast<float>(), other = part.touch.other.cast<float>();
  return {.organ_one = part.organ_one,
          .organ_other = part.organ_other,
          .one_x = one.x(),
          .one_y = one.y(),
          .one_z = one.z(),
          .other_x = other.x(),
          .other_y = other.y(),
          .other_z = other.z(),
          .radius_one = static_cast<float>(part.touch.radius_one_m),
          .radius_other = static_cast<float>(part.touch.radius_other_m),
          .push = static_cast<float>(part.touch.push_n)};
}

}  // namespace omentum::deform
