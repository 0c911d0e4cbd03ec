#include "runtime/tick_account.h"

namespace omentum::runtime {

void TickAccount::start(std::int64_t now_ns) noexcept {
  if (started_) {
    last_period_ns_ = now_ns - start_ns_;
    record_.period.add_ns(last_period_ns_);
  }
  started_ = true;
  start_ns_ = now_ns;
}

void TickAccount::finish(std::int64_t now_ns) noexcept {
  last_compute_ns_ = now_ns - start_ns_;
  record_.compute.add_ns(last_compute_ns_);
  if (record_.ticks++ == 0) {
    open_ns_ = now_ns + period_ns_ / 2;
  } else if (now_ns < open_ns_) {
    open_ns_ = now_ns + period_ns_;
  } else {
    const std::int64_t empty = (now_ns - open_ns_) / period_ns_;
    record_.missed += static_cast<std::uint64_t>(empty);
    open_ns_ += (empty + 1) * period_ns_;
  }
}

}  // namespace omentum::runtime
