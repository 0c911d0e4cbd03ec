#include "deform_node/owed_time.h"

#include <algorithm>

namespace omentum::deform {

int OwedTime::take(std::uint64_t missed, bool in_time) noexcept {
  owed_ = std::min(owed_ + missed - seen_, kMost);
  seen_ = missed;
  late_ = in_time ? 0 : std::min(late_ + 1, kMostLate);
  const std::uint64_t now = late_ < kMostLate ? std::min(owed_, kMostAtOnce) : 0;
  owed_ -= now;
  return static_cast<int>(1 + now);
}

void OwedTime::forgive(std::uint64_t missed) noexcept {
  seen_ = missed;
  owed_ = 0;
}

}  // namespace omentum::deform
