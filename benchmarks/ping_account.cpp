#include "benchmarks/ping_account.h"

namespace omentum::bench {

std::uint64_t PingAccount::send(std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  ++sent_;
  sent_ns_[sent_ % kRemembered] = now_ns;
  return sent_;
}

bool PingAccount::receive(std::uint64_t seq, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  if (seq == 0 || seq > sent_ || sent_ - seq >= kRemembered) return false;
  std::int64_t& sent_ns = sent_ns_[seq % kRemembered];
  if (sent_ns == kBack) return false;
  times_.add_ns(now_ns - sent_ns);
  sent_ns = kBack;
  return true;
}

std::uint64_t PingAccount::sent() const {
  const std::lock_guard lock(mutex_);
  return sent_;
}

std::uint64_t PingAccount::lost() const {
  const std::lock_guard lock(mutex_);
  return sent_ - times_.count();
}

runtime::Percentiles PingAccount::round_trip() const {
  const std::lock_guard lock(mutex_);
  return times_.percentiles();
}

}  // namespace omentum::bench
