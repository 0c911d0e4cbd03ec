// Periods in which a loop had no tick, and what is lived through later instead.
#pragma once

#include <cstdint>

namespace omentum::deform {

/// Simulated time follows the clock although a busy machine takes ticks away: a tick lives through its own
/// period and through some that are owed, as long as now and then one ends within its period. One thread;
/// nothing allocates.
class OwedTime {
 public:
  /// Of one tick: more at once would be a leap under the hand.
  static constexpr std::uint64_t kMostAtOnce = 2;
  /// More than so many are given up: a node that stood still for long does not hurry for seconds.
  static constexpr std::uint64_t kMost = 10;

  /// So many late ticks in turn are the node's own slowness: a busy machine leaves one of them alone.
  static constexpr int kMostLate = 32;

  /// Periods that this tick lives through, at least 1. `missed`: of the loop since its start. `in_time`: the
  /// last tick ended within its period; a node whose ticks never do has no time to make up for anything.
  int take(std::uint64_t missed, bool in_time) noexcept;
  /// What was missed so far is owed to nobody: the organs stood still then.
  void forgive(std::uint64_t missed) noexcept;

 private:
  std::uint64_t seen_ = 0, owed_ = 0;
  int late_ = 0;  // ticks in turn, up to kMostLate
};

}  // namespace omentum::deform
