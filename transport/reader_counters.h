// What a reader counts itself, equal for both vendors.
#pragma once

#include "transport/topics.h"

#include <array>
#include <atomic>
#include <chrono>
#include <limits>

namespace omentum::transport {

/// Counts the whole deadline periods that passed between two samples of a tool, and since its last. DDS'
/// own deadline costs a timer per sample on the receiving side: the round trip through Fast DDS was 112-127
/// us with it and 48-90 us without (docs/topics.md), so that writers offer a deadline and readers count.
class DeadlineCounter {
 public:
  explicit DeadlineCounter(std::chrono::nanoseconds period) : period_ns_(period.count()) {
    for (auto& last_ns : last_ns_) last_ns.store(kNever_ns, std::memory_order_relaxed);
  }

  /// One thread at a time; neither waits nor allocates. now_ns: when the sample came, on any steady clock.
  /// Tools from msg::MAX_TOOLS on are not counted.
  void arrived(std::uint32_t tool, std::int64_t now_ns) noexcept {
    if (tool >= last_ns_.size()) return;
    const std::int64_t last_ns = last_ns_[tool].exchange(now_ns, std::memory_order_relaxed);
    // released after the time above: who sees this gap counted does not see it open any more
    missed_.fetch_add(periods(last_ns, now_ns), std::memory_order_release);
  }

  /// Any thread; never waits.
  std::uint64_t missed(std::int64_t now_ns) const noexcept {
    std::uint64_t missed = missed_.load(std::memory_order_acquire);
    for (const auto& last_ns : last_ns_) missed += periods(last_ns.load(std::memory_order_relaxed), now_ns);
    return missed;
  }

 private:
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  // none from kNever_ns on
  std::uint64_t periods(std::int64_t from_ns, std::int64_t to_ns) const noexcept {
    return to_ns > from_ns ? static_cast<std::uint64_t>((to_ns - from_ns) / period_ns_) : 0;
  }

  const std::int64_t period_ns_;
  std::array<std::atomic<std::int64_t>, msg::MAX_TOOLS> last_ns_;  // when each tool's newest sample came
  std::atomic<std::uint64_t> missed_{0};
};

/// The counters of one reader of M. delivered() is for one thread at a time, all else for any; nothing waits.
template <class M>
class ReaderCounters {
 public:
  void delivered(const M& sample) noexcept {
    ++samples_;
    if constexpr (kCountsDeadline) deadline_.arrived(sample.tool, now_ns());
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
