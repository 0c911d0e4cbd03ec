// What a loop's ticks add up to: periods, compute times, misses.
#pragma once

#include "runtime/histogram.h"

#include <cstdint>

namespace omentum::runtime {

/// Period and compute time of every tick, and how many nominal periods saw no tick finish.
struct LoopRecord {
  Histogram period;   // from start of a tick to start of the next
  Histogram compute;  // from start to finish
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;
};

/// Book-keeping on given times; it reads no clock. One thread.
///
/// A miss is a nominal period P = 1/rate in which no tick finished. The periods follow one another
/// without gaps; the first finish lies in the middle of its period. Where a finish falls into a period that
/// already had one (a device slightly faster than the nominal rate, or an extra tick), the periods move
/// forward with it: that finish opens a new period. Hence
/// - gaps of at most P between finishes never count; at a steady rate of 1/P, jitter below P/2 (from the
///   earliest to the latest) does not either;
/// - a loop that is too slow cannot hide: ticks + missed >= elapsed / P - 1, whatever the gaps are;
/// - a gap of g counts floor(g / P) periods at most and floor(g / P) - 1 at least.
class TickAccount {
 public:
  explicit TickAccount(std::int64_t period_ns) : period_ns_(period_ns) {}

  void start(std::int64_t now_ns) noexcept;
  void finish(std::int64_t now_ns) noexcept;

  std::int64_t last_start_ns() const { return start_ns_; }
  std::int64_t last_period_ns() const { return last_period_ns_; }  // 0 at the first tick
  std::int64_t last_compute_ns() const { return last_compute_ns_; }
  const LoopRecord& record() const { return record_; }

 private:
  std::int64_t period_ns_;
  std::int64_t start_ns_ = 0;
  std::int64_t last_period_ns_ = 0;
  std::int64_t last_compute_ns_ = 0;
  std::int64_t open_ns_ = 0;  // begin of the first period in which no tick finished yet
  bool started_ = false;
  LoopRecord record_;
};

}  // namespace omentum::runtime
