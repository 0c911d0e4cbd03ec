// A loop that ticks at a fixed rate, or earlier when somebody wakes it.
#pragma once

#include "runtime/histogram.h"

#include <atomic>
#include <cstdint>

namespace omentum::runtime {

/// Counts a tick as missed when none finished within a period (a gap of n whole periods between two
/// finishes counts n - 1... see .cpp), and keeps period and compute time.
struct LoopRecord {
  Histogram period;    // from start of a tick to start of the next
  Histogram compute;   // from start to finish
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;
};

/// Waits for the next tick. wake() (any thread, wait-free) ends the wait early: the arrival of a pose. Without
/// a wake the tick comes at a fixed rate against absolute time (no drift); after a wake the fixed schedule
/// restarts from it plus `grace_periods`, so that a device's own rhythm rules while it speaks.
class RateLoop {
 public:
  explicit RateLoop(double rate_hz);
  enum class Cause { kSchedule, kWoken, kStopped };

  Cause wait() noexcept;          // also records the period
  void finish_tick() noexcept;    // records compute time and misses
  void wake() noexcept;
  void stop() noexcept;           // any thread, also a signal handler: wait() returns kStopped

  double rate_hz() const;
  const LoopRecord& record() const;  // the loop's thread, or after it ended
 private:
  // futex or condition variable: implementer's choice
};

}  // namespace omentum::runtime
