// What a held force lags behind, given back.
#pragma once

#include "haptic_node/wrench.h"

namespace omentum::haptic {

/// A device holds each answer until the next one: over a motion the force that it exerts is on average the
/// one of half an interval ago, and a spring that is felt so gives K dx^2 / 2 a sample more than it took
/// (Colgate and Schenkel 1997; 2.6 % of a light press at 1 kHz, 8 % at 300 Hz). So a moving hand is answered
/// for where it will be half an interval later: half of what the force changed by since its last pose is
/// added, but never more than half of the force itself; where there is none, none is added.
///
/// Plain arithmetic. One thread.
class HoldLead {
 public:
  /// A tip that moved less than this from pose to pose rests, m: what a tracker trembles by.
  static constexpr double kResting_m = 1e-6;

  /// Every tick. `new_pose`: the tip is at a pose that was not answered before.
  Wrench ahead(const Wrench& model, bool new_pose, const Vec3& tip) noexcept;
  /// What comes next is another hand, or elsewhere.
  void restart() noexcept { *this = {}; }

 private:
  bool known_ = false;
  Vec3 tip_ = Vec3::Zero();
  Wrench answered_;  // the model's, at the last pose
  Wrench lead_;
};

}  // namespace omentum::haptic
