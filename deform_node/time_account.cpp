#include "deform_node/time_account.h"

#include <utility>

namespace omentum::deform {

void TimeAccount::note(std::int64_t now_ns, double lived_s, bool stood_still) noexcept {
  const double passed_s = last_ns_ == 0 ? 0 : 1e-9 * static_cast<double>(now_ns - last_ns_);
  const double newly_lived_s = lived_s - std::exchange(last_lived_, lived_s);
  last_ns_ = now_ns;
  stands_still_ = stood_still;
  if (stood_still || passed_s <= 0) return;
  passed_ += passed_s;
  lived_ += newly_lived_s;
  marks_[oldest_] = {passed_, lived_};
  oldest_ = (oldest_ + 1) % kRecent;
}

double TimeAccount::recent() const noexcept {
  const Mark& from = marks_[oldest_];
  const double passed_s = passed_ - from.passed_s;
  return stands_still_ || !(passed_s > 0) ? 0 : (lived_ - from.lived_s) / passed_s;
}

}  // namespace omentum::deform
