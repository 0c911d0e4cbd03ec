#include "haptic_node/pose_interval.h"

#include <algorithm>

namespace omentum::haptic {

void PoseInterval::add(std::int64_t arrival_ns) noexcept {
  intervals_ns_[static_cast<std::size_t>(next_)] = arrival_ns - last_ns_;
  last_ns_ = arrival_ns;
  next_ = (next_ + 1) % kWindow;
  count_ = std::min(count_ + 1, kWindow);
}

void PoseInterval::restart(std::int64_t arrival_ns) noexcept {
  *this = {};
  last_ns_ = arrival_ns;
}

double PoseInterval::seconds() const noexcept {
  if (count_ < kEnough) return 0;
  std::array<std::int64_t, kWindow> sorted = intervals_ns_;
  const auto middle = sorted.begin() + count_ / 2;
  std::nth_element(sorted.begin(), middle, sorted.begin() + count_);
  return 1e-9 * static_cast<double>(*middle);
}

}  // namespace omentum::haptic
