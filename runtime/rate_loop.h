// A loop that ticks at a fixed rate, or earlier when somebody wakes it.
#pragma once

#include "runtime/tick_account.h"
#include "runtime/wake_gate.h"

#include <atomic>
#include <cstdint>

namespace omentum::runtime {

class LoopObserver;

/// Waits for the next tick. wake() (any thread, wait-free) ends the wait early: the arrival of a pose.
/// Without wakes the tick comes at a fixed rate against absolute time (no drift). After a wake the fixed
/// schedule restarts from it plus 1.5 periods, so that a device's own rhythm rules while it speaks. Several
/// tools' poses of one period make one tick: the rule is WakeGate's. What counts as a miss: TickAccount.
///
///     while (loop.wait() != RateLoop::Cause::kStopped) { step(); loop.finish_tick(); }
class RateLoop {
 public:
  enum class Cause { kSchedule, kWoken, kStopped };

  /// Throws std::invalid_argument unless 0.1 <= rate_hz <= 100,000.
  explicit RateLoop(double rate_hz);
  RateLoop(const RateLoop&) = delete;
  RateLoop& operator=(const RateLoop&) = delete;

  /// Every tick from now on goes to `log` as well, which must outlive the loop. Call before the first wait().
  void log_to(LoopObserver& log) { log_ = &log; }

  Cause wait() noexcept;        // also records the period
  void finish_tick() noexcept;  // records compute time and misses
  void wake() noexcept;         // any thread, also a signal handler
  void stop() noexcept;         // any thread, also a signal handler: wait() returns kStopped

  double rate_hz() const { return rate_hz_; }
  /// When the running tick started, steady clock, ns. The loop's thread.
  std::int64_t tick_start_ns() const { return account_.last_start_ns(); }
  /// The loop's thread, or any after it ended.
  const LoopRecord& record() const { return account_.record(); }

 private:
  double rate_hz_;
  TickAccount account_;
  WakeGate gate_;
  Cause cause_ = Cause::kStopped;
  LoopObserver* log_ = nullptr;
  std::atomic<std::uint32_t> wakes_{0};  // the futex word
  std::atomic<std::int64_t> last_wake_ns_{0};
  std::atomic<bool> stopped_{false};
};

}  // namespace omentum::runtime
