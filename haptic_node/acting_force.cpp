#include "haptic_node/acting_force.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

// What an answer and its pose need on the wire, together, s: what was written at the beginning of a way was
// not exerted yet.
constexpr double kOnItsWay_s = 0.2e-3;
// From nothing to the device's limit after an expiry, s.
constexpr double kFadeIn_s = 0.2;

double share_within(double amount, double limit) {
  return amount > limit ? limit / amount : 1;
}

}  // namespace

void ActingForce::tell(const Wrench& wrench, double valid_s, double age_s) noexcept {
  const double at_s = now_s_ - age_s;
  if (at_s > told_[newest_].at_s + told_[newest_].valid_s) fade_begin_s_ = at_s;
  newest_ = (newest_ + 1) % kTold;
  told_[newest_] = {wrench, valid_s, at_s};
}

// Held in full, then down to nothing within decay_s_.
double ActingForce::share_at(const Told& told, double time_s) const noexcept {
  return std::clamp(1 - (time_s - told.at_s - told.valid_s) / decay_s_, 0.0, 1.0);
}

// The share of the wrench that is exerted at least, because the device has let it in by now.
double ActingForce::faded_in(const Wrench& wrench) const noexcept {
  const double allowed = (now_s_ - fade_begin_s_) / kFadeIn_s;
  return std::min({share_within(wrench.force.norm(), allowed * max_force_n_),
                   share_within(wrench.torque.norm(), allowed * max_torque_nm_),
                   share_within(std::abs(wrench.grip_torque), allowed * max_torque_nm_)});
}

double ActingForce::work_of(const Told& told, double told_j, double begin_s) const noexcept {
  // what the hand put in is not believed before the force was surely there
  const double full_j = told_j < 0 ? told_j * faded_in(told.wrench) : told_j;
  // as at the beginning of the way, or as at its end: it may have been gone early or late
  return std::max(full_j * share_at(told, begin_s), full_j * share_at(told, now_s_));
}

ActingForce::Work ActingForce::work(const Vec3& way, const Vec3& turn, double took_s,
                                    double opened_rad) const noexcept {
  const double begin_s = now_s_ - took_s;
  Work work;
  for (std::size_t back = 0; back < kTold; ++back) {
    const Told& told = told_[(newest_ + kTold - back) % kTold];
    const double told_j =
        told.wrench.force.dot(way) + told.wrench.torque.dot(turn) + told.wrench.grip_torque * opened_rad;
    work.late_j = work_of(told, told_j, begin_s);
    const bool since = told.at_s >= begin_s - kOnItsWay_s;
    if (back == 0 || since) work.soon_j = back == 0 ? work.late_j : std::max(work.soon_j, work.late_j);
    if (!since) break;
  }
  return work;
}

}  // namespace omentum::haptic
