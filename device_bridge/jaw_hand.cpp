#include "device_bridge/jaw_hand.h"

#include <algorithm>

namespace omentum::device {

double step_jaws(double grip_rad, JawWish wish, double torque_nm, double dt_s) noexcept {
  const double excess = torque_nm / kSqueeze_nm - 1;
  double share = 1;
  if (wish == JawWish::kClose) share = std::clamp(excess, -1.0, 1.0);
  if (wish == JawWish::kStay) share = std::clamp(excess, 0.0, 1.0);
  // a simulated hand may have left them farther open
  return std::clamp(grip_rad + kJawRate_rad_s * share * dt_s, 0.0, std::max(kJawsOpen_rad, grip_rad));
}

}  // namespace omentum::device
