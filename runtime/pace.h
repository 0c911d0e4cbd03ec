// What paces a loop: the seam between what a node does and when.
#pragma once

#include "runtime/clock.h"
#include "runtime/tick_account.h"
#include "runtime/woken_thread.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

namespace omentum::runtime {

class LoopObserver;

/// Work that goes on beside a loop until this is destroyed.
class SideWork {
 public:
  virtual ~SideWork() = default;
};

/// Gives a loop its ticks and its time.
///
///     while (pace.wait() != Pace::Cause::kStopped) { step(); pace.finish_tick(); }
///
/// Nodes ask nobody else for the time, so that one that is driven by a script (a test's) knows no other.
class Pace : public Clock {
 public:
  enum class Cause { kSchedule, kWoken, kStopped };

  /// Every tick from now on goes to `log` as well, which must outlive the loop. Call before the first wait().
  virtual void log_to(LoopObserver& log) = 0;

  virtual Cause wait() noexcept = 0;        // also records the period
  virtual void finish_tick() noexcept = 0;  // records compute time and misses
  virtual void wake() noexcept = 0;         // any thread, also a signal handler: the next tick comes early
  virtual void stop() noexcept = 0;         // any thread, also a signal handler: wait() returns kStopped

  /// Calls `work`, which must not throw, one `pause` after its last call ended, on an ordinary thread. This
  /// must outlive what it returns.
  virtual std::unique_ptr<SideWork> beside(std::chrono::milliseconds pause, std::function<void()> work) = 0;

  /// Does `work`, which must not throw, whenever what it returns is woken (woken_thread.h).
  virtual std::unique_ptr<WokenWork> on_wake(std::function<void()> work) = 0;

  /// The loop's thread, or any after it ended.
  virtual const LoopRecord& record() const = 0;
};

}  // namespace omentum::runtime
