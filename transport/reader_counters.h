// What a reader counts itself, equal for both vendors.
#pragma once

#include "transport/topics.h"

#include <array>
#include <atomic>
#include <map>
#include <mutex>

namespace omentum::transport {

/// The members that tell a topic's instances apart, widened.
using KeyValue = std::array<std::uint64_t, 2>;

template <class M>
KeyValue key_value(const M& message) noexcept {
  KeyValue key{};
  std::size_t next = 0;
  for_each_field(message, [&](const msg::Field& field, const auto& member) {
    if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(member)>>) {
      if (field.key) key[next++] = static_cast<std::uint64_t>(member);
    }
  });
  return key;
}

/// Counts the whole deadline periods that passed between two samples of a key, and since its last. DDS'
/// own deadline costs a timer per sample on the receiving side: the round trip through Fast DDS was 112-127
/// us with it and 48-90 us without (docs/topics.md), so that writers offer a deadline and readers count.
/// Any thread; a lock is held for some instructions.
class DeadlineCounter {
 public:
  explicit DeadlineCounter(std::chrono::nanoseconds period) : period_ns_(period.count()) {}

  /// now_ns: when the sample came, on any steady clock.
  void arrived(const KeyValue& key, std::int64_t now_ns) {
    // a foreign writer must not make us remember keys without end
    constexpr std::size_t kMostKeys = 64;
    const std::lock_guard lock(mutex_);
    const auto found = last_ns_.find(key);
    if (found != last_ns_.end()) {
      missed_ += periods(found->second, now_ns);
      found->second = now_ns;
    } else if (last_ns_.size() < kMostKeys) {
      last_ns_.emplace(key, now_ns);
    }
  }

  std::uint64_t missed(std::int64_t now_ns) const {
    const std::lock_guard lock(mutex_);
    std::uint64_t missed = missed_;
    for (const auto& [key, last_ns] : last_ns_) missed += periods(last_ns, now_ns);
    return missed;
  }

 private:
  std::uint64_t periods(std::int64_t from_ns, std::int64_t to_ns) const {
    return to_ns > from_ns ? static_cast<std::uint64_t>((to_ns - from_ns) / period_ns_) : 0;
  }

  const std::int64_t period_ns_;
  mutable std::mutex mutex_;  // guards what follows
  std::map<KeyValue, std::int64_t> last_ns_;
  std::uint64_t missed_ = 0;
};

/// The counters of one reader of M. Any thread.
template <class M>
class ReaderCounters {
 public:
  void delivered(const M& sample) {
    ++samples_;
    if constexpr (kCountsDeadline) deadline_.arrived(key_value(sample), now_ns());
  }
  void rejected() { ++rejected_; }
  /// change: of the number of writers that are known and not alive
  void liveliness_changed(int change) {
    if (change > 0) liveliness_lost_ += static_cast<std::uint64_t>(change);
  }

  void add_to(EndpointStatus& status) const {
    status.samples = samples_;
    status.rejected = rejected_;
    status.liveliness_lost = liveliness_lost_;
    if constexpr (kCountsDeadline) status.deadline_missed = deadline_.missed(now_ns());
  }

 private:
  static constexpr bool kCountsDeadline = kTopicSpec<M>.deadline.count() > 0;
  static std::int64_t now_ns() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  }

  std::atomic<std::uint64_t> samples_{0};
  std::atomic<std::uint64_t> rejected_{0};
  std::atomic<std::uint64_t> liveliness_lost_{0};
  DeadlineCounter deadline_{kTopicSpec<M>.deadline};
};

}  // namespace omentum::transport
