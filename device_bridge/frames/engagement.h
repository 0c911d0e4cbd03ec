// How much of a force a hand feels while it takes hold and lets go.
#pragma once

#include <algorithm>

namespace omentum::device {

/// A share that goes from 0 to 1 in kTakeHold_s and back in kLetGo_s: as fast as a force fades in after a
/// pause, and decays where answers stop (ForceHold).
class Engagement {
 public:
  static constexpr double kTakeHold_s = 0.2, kLetGo_s = 0.02;

  /// dt_s went by, in which the hand held the tool, or did not.
  double pass(bool holds, double dt_s) noexcept {
    return share_ = std::clamp(share_ + (holds ? dt_s / kTakeHold_s : -dt_s / kLetGo_s), 0.0, 1.0);
  }
  double share() const noexcept { return share_; }

 private:
  double share_ = 0;
};

}  // namespace omentum::device
