// Periods in which a loop had no tick, and what is lived through later instead.
#pragma once

#include <cstdint>

namespace omentum::deform {

/// Simulated time follows the clock although a busy machine takes ticks away: each tick lives through its own
/// period and one of those that are owed, until none is. One thread; nothing allocates.
class OwedTime {
 public:
  /// More than so many are given up: a node that stood still for long does not hurry for seconds, and one
  /// that is too slow for its rate says so by its real-time factor.
  static constexpr std::uint64_t kMost = 10;

  /// Periods that this tick lives through, 1 or 2. `missed`: of the loop since its start.
  int take(std::uint64_t missed) noexcept;
  /// What was missed so far is owed to nobody: the organs stood still then.
  void forgive(std::uint64_t missed) noexcept;

 private:
  std::uint64_t seen_ = 0, owed_ = 0;
};

}  // namespace omentum::deform
