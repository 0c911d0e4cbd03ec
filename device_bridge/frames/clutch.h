// A clutch: the hand comes back to the middle of its workspace, and the tool waits.
#pragma once

#include "device_bridge/device.h"

namespace omentum::device {

/// While it is held the pose stays as it was; from then on it goes on from there, displaced by as much as the
/// hand moved meanwhile and turned in the tool's own axes, so that velocities are the hand's and no power is
/// lost or made:
///
///     p = p_hand + d,   q = q_hand q_d
///
/// Jaws and buttons are the hand's all the time: an opening has a zero that no clutch may move. Reads no
/// clock. One thread.
class Clutch {
 public:
  /// The pose that counts.
  Measurement follow(const Measurement& hand, bool held) noexcept;
  bool held() const noexcept { return held_; }

 private:
  void freeze(const Measurement& hand) noexcept;

  bool held_ = false;
  Vec3 displacement_ = Vec3::Zero();  // d, m
  Quat turn_ = Quat::Identity();      // q_d
  Vec3 position_ = Vec3::Zero();      // the pose that stays
  Quat orientation_ = Quat::Identity();
};

}  // namespace omentum::device
