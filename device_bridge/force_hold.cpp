#include "device_bridge/force_hold.h"

#include <algorithm>
#include <cmath>

namespace omentum::device {
namespace {

constexpr double kLongestValidity_s = 0.1;  // an answer that claims more is not believed

Vec3 clamped(const Vec3& v, double limit) {
  const double norm = v.norm();
  return norm > limit ? Vec3(v * (limit / norm)) : v;
}

}  // namespace

bool ForceHold::take(const msg::ToolForce& answer, std::int64_t now_ns) noexcept {
  const Vec3 force = from_message(answer.force), torque = from_message(answer.torque);
  if (!force.allFinite() || !torque.allFinite() || !std::isfinite(answer.grip_torque)) return false;
  newest_ = {clamped(force, max_force_n_), clamped(torque, max_torque_nm_),
             std::clamp(answer.grip_torque, -max_torque_nm_, max_torque_nm_)};
  // written so that a validity that is not a number counts as none
  const double valid_s = answer.valid_for_s > 0 ? std::min(answer.valid_for_s, kLongestValidity_s) : 0;
  valid_until_ns_ = now_ns + static_cast<std::int64_t>(1e9 * valid_s);
  fresh_ = true;
  return true;
}

Wrench ForceHold::at(std::int64_t now_ns) noexcept {
  const double stale_s = 1e-9 * static_cast<double>(now_ns - valid_until_ns_);
  if (stale_s <= 0) return newest_;
  if (fresh_) ++expired_;
  fresh_ = false;
  const double share = std::max(0.0, 1 - stale_s / kDecay_s);
  return {newest_.force * share, newest_.torque * share, newest_.grip_torque * share};
}

}  // namespace omentum::device
