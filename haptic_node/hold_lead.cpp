#include "haptic_node/hold_lead.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// Half of it, shortened to `most`.
Vec3 half(const Vec3& way, double most) {
  const double length = 0.5 * way.norm();
  return length > most ? Vec3(most / way.norm() * way) : Vec3(0.5 * way);
}

}  // namespace

ToolFrame HoldLead::ahead(const ToolFrame& measured, bool new_pose) noexcept {
  if (!new_pose && known_) return ahead_;
  ahead_ = measured;
  if (known_) {
    ahead_.p_WT += half(measured.p_WT - measured_.p_WT, kMost_m);
    const Vec3 turn = half(rotation_between(measured_.q_WT, measured.q_WT), kMost_rad);
    const double angle = turn.norm();
    if (angle > 0) ahead_.q_WT = (Eigen::AngleAxisd(angle, turn / angle) * measured.q_WT).normalized();
  }
  known_ = true;
  measured_ = measured;
  return ahead_;
}

}  // namespace omentum::haptic
