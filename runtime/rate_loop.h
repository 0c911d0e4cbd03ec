// A loop that ticks at a fixed rate, or earlier when somebody wakes it.
#pragma once

#include "runtime/pace.h"
#include "runtime/wake_gate.h"

#include <atomic>
#include <cstdint>

namespace omentum::runtime {

/// The pace of a real node. Waits for the next tick. wake() (any thread, wait-free) ends the wait early: the
/// arrival of a pose. Without wakes the tick comes at a fixed rate against absolute time (no drift). After a
/// wake the fixed schedule restarts from it plus 1.5 periods, so that a device's own rhythm rules while it
/// speaks. Several tools' poses of one period make one tick: the rule is WakeGate's. What counts as a miss:
/// TickAccount.
class RateLoop final : public Pace {
 public:
  /// Throws std::invalid_argument unless 0.1 <= rate_hz <= 100,000.
  explicit RateLoop(double rate_hz);
  RateLoop(const RateLoop&) = delete;
  RateLoop& operator=(const RateLoop&) = delete;

  void log_to(LoopObserver& log) override { log_ = &log; }
  Cause wait() noexcept override;
  void finish_tick() noexcept override;
  void wake() noexcept override;
  void stop() noexcept override;
  std::unique_ptr<SideWork> beside(std::chrono::milliseconds pause, std::function<void()> work) override;
  std::unique_ptr<WokenWork> on_wake(std::function<void()> work) override;
  const LoopRecord& record() const override { return account_.record(); }
  std::int64_t now_ns() const noexcept override { return steady_now_ns(); }

  double rate_hz() const { return rate_hz_; }

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
