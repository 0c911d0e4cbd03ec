#include "deform_node/owed_time.h"

#include <algorithm>

namespace omentum::deform {

int OwedTime::take(std::uint64_t missed) noexcept {
  owed_ = std::min(owed_ + missed - seen_, kMost);
  seen_ = missed;
  if (owed_ == 0) return 1;
  --owed_;
  return 2;
}

void OwedTime::forgive(std::uint64_t missed) noexcept {
  seen_ = missed;
  owed_ = 0;
}

}  // namespace omentum::deform
