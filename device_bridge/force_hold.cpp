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

Wrench scaled(const Wrench& w, double share) {
  return {w.force * share, w.torque * share, w.grip_torque * share};
}

// a limit of zero is never used
double share_of(double amount, double limit) {
  return limit > 0 ? amount / limit : 0;
}

}  // namespace

bool ForceHold::take(const msg::ToolForce& answer, std::int64_t now_ns) noexcept {
  const Vec3 force = from_message(answer.force), torque = from_message(answer.torque);
  if (!force.allFinite() || !torque.allFinite() || !std::isfinite(answer.grip_torque)) return false;
  // an expiry counts although at() was not called meanwhile: the motors kept what it gave last
  if (!held_ || now_ns > valid_until_ns_) {
    fades_in_ = true;
    fade_begin_ns_ = now_ns;
    fade_begin_effort_ = effort(exerted_);
  }
  newest_ = {clamped(force, max_force_n_), clamped(torque, max_torque_nm_),
             std::clamp(answer.grip_torque, -max_torque_nm_, max_torque_nm_)};
  newest_seq_ = answer.seq;
  // written so that a validity that is not a number counts as none
  const double valid_s = answer.valid_for_s > 0 ? std::min(answer.valid_for_s, kLongestValidity_s) : 0;
  valid_until_ns_ = now_ns + static_cast<std::int64_t>(1e9 * valid_s);
  held_ = true;
  return true;
}

Wrench ForceHold::at(std::int64_t now_ns) noexcept {
  const double stale_s = 1e-9 * static_cast<double>(now_ns - valid_until_ns_);
  exerted_seq_ = stale_s < kDecay_s ? newest_seq_ : 0;
  if (stale_s > 0) {
    exerted_ = decaying(stale_s);
  } else {
    exerted_ = fades_in_ ? fading_in(now_ns) : newest_;
  }
  return exerted_;
}

Wrench ForceHold::decaying(double stale_s) noexcept {
  if (held_) {
    ++expired_;
    decays_from_ = exerted_;
  }
  held_ = false;
  return scaled(decays_from_, std::max(0.0, 1 - stale_s / kDecay_s));
}

// The newest answer, shortened to the effort that may have come back by now; direction and the ratio of force
// and torque are kept.
Wrench ForceHold::fading_in(std::int64_t now_ns) noexcept {
  // an answer may have arrived after the moment of this tick
  const double faded_s = std::max(0.0, 1e-9 * static_cast<double>(now_ns - fade_begin_ns_));
  const double allowed = fade_begin_effort_ + faded_s / kFadeIn_s;
  const double asked = effort(newest_);
  fades_in_ = asked > allowed;
  return fades_in_ ? scaled(newest_, allowed / asked) : newest_;
}

// The largest share of a limit that the wrench takes, 0..1.
double ForceHold::effort(const Wrench& wrench) const noexcept {
  return std::max({share_of(wrench.force.norm(), max_force_n_),
                   share_of(wrench.torque.norm(), max_torque_nm_),
                   share_of(std::abs(wrench.grip_torque), max_torque_nm_)});
}

}  // namespace omentum::device
