// Which parts of a scene's organs touch.
#pragma once

#include "deform_node/organ_group.h"
#include "transport/messages.h"

namespace omentum::deform {

/// Two parts that touch, of these organs of the scene; of one organ where both are the same.
struct TouchingPart {
  std::uint32_t organ_one = 0, organ_other = 0;
  physics::Touch touch;
};

/// All of a moment, up to as many as there is memory for. No allocation after construction.
class TouchingParts {
 public:
  TouchingParts() = default;
  explicit TouchingParts(std::size_t most) : parts_(most), of_organ_(most) {}

  /// Each organ with itself, then each two, as the newest step left them (OrganCollision::met).
  void take(const OrganGroup& organs) noexcept;
  std::span<TouchingPart> all() noexcept { return std::span(parts_).first(count_); }

 private:
  void add(std::size_t one, std::size_t other, std::span<const physics::Touch> touches) noexcept;

  std::vector<TouchingPart> parts_;
  std::vector<physics::Touch> of_organ_;  // workspace
  std::size_t count_ = 0;
};

/// Brings the hardest pushed of `parts` to the front, in no order, and returns them: at most
/// msg::MAX_TOUCHING_PAIRS.
std::span<const TouchingPart> hardest_pushed(std::span<TouchingPart> parts) noexcept;
msg::TouchingPair to_message(const TouchingPart& part) noexcept;

}  // namespace omentum::deform
