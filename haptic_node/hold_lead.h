// Where a tool will be in the middle of the time for which its answer is held.
#pragma once

#include "haptic_node/tool_kinematics.h"

namespace omentum::haptic {

/// A device holds each answer until the next one: over a motion the force that it exerts is on average the
/// one of half an interval ago, and a spring that is felt so gives K dx^2 / 2 a sample more than it took
/// (Colgate and Schenkel 1997; 2.6 % of a light press at 1 kHz, 8 % at 300 Hz). So contact is computed for
/// where the tool will be half an interval after its pose: half a way further, half a turn further. A tool
/// that rests is where it is.
///
/// Plain arithmetic. One thread.
class HoldLead {
 public:
  /// The farthest that is led, m and rad: half a way at 0.6 m/s and 300 Hz. Faster hands feel the rest of the
  /// hold.
  static constexpr double kMost_m = 1e-3;
  static constexpr double kMost_rad = 0.05;

  /// Every tick. `new_pose`: `measured` is a pose that was not answered before.
  ToolFrame ahead(const ToolFrame& measured, bool new_pose) noexcept;
  /// What comes next is another hand, or elsewhere.
  void restart() noexcept { *this = {}; }

 private:
  bool known_ = false;
  ToolFrame measured_, ahead_;
};

}  // namespace omentum::haptic
