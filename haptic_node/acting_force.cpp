#include "haptic_node/acting_force.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// What an answer and its pose need on the wire, together, s: what was written at the beginning of a way was
// not exerted yet.
constexpr double kOnItsWay_s = 0.2e-3;

}  // namespace

void ActingForce::tell(const Wrench& wrench, double valid_s, double age_s) noexcept {
  newest_ = (newest_ + 1) % kTold;
  told_[newest_] = {wrench, valid_s, now_s_ - age_s};
}

// Held in full, then down to nothing within decay_s_.
double ActingForce::share_at(const Told& told, double time_s) const noexcept {
  return std::clamp(1 - (time_s - told.at_s - told.valid_s) / decay_s_, 0.0, 1.0);
}

double ActingForce::work_of(const Told& told, const Vec3& way, const Vec3& turn,
                            double begin_s) const noexcept {
  const double full_j = told.wrench.force.dot(way) + told.wrench.torque.dot(turn);
  // as at the beginning of the way, or as at its end: it may have been gone early or late
  return std::max(full_j * share_at(told, begin_s), full_j * share_at(told, now_s_));
}

ActingForce::Work ActingForce::work(const Vec3& way, const Vec3& turn, double took_s) const noexcept {
  const double begin_s = now_s_ - took_s;
  Work work;
  for (std::size_t back = 0; back < kTold; ++back) {
    const Told& told = told_[(newest_ + kTold - back) % kTold];
    work.late_j = work_of(told, way, turn, begin_s);
    const bool since = told.at_s >= begin_s - kOnItsWay_s;
    if (back == 0 || since) work.soon_j = back == 0 ? work.late_j : std::max(work.soon_j, work.late_j);
    if (!since) break;
  }
  return work;
}

}  // namespace omentum::haptic
