#include "device_bridge/frames/clutch.h"

namespace omentum::device {

void Clutch::freeze(const Measurement& hand) noexcept {
  position_ = hand.position + displacement_;
  orientation_ = (hand.orientation * turn_).normalized();
}

Measurement Clutch::follow(const Measurement& hand, bool held) noexcept {
  if (held && !held_) freeze(hand);
  if (!held && held_) {
    displacement_ = position_ - hand.position;
    turn_ = (hand.orientation.conjugate() * orientation_).normalized();
  }
  held_ = held;
  Measurement followed = hand;
  if (held_) {
    followed.position = position_;
    followed.orientation = orientation_;
    followed.linear_velocity.setZero();
    followed.angular_velocity.setZero();
  } else {
    followed.position += displacement_;
    followed.orientation = hand.orientation * turn_;
  }
  return followed;
}

}  // namespace omentum::device
