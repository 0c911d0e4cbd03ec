// A pace whose ticks and time a test gives.
#pragma once

#include "runtime/loop_log.h"
#include "runtime/pace.h"

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <semaphore>
#include <thread>
#include <vector>

namespace omentum::test {

/// Runs a node's whole loop in lockstep with a test. The loop has a thread of its own, which goes on only
/// while the test waits in tick(), and comes back at its next wait(): between two calls everything stands
/// still, its clock too, and what a bus delivers then (fake_bus.h) comes between two ticks. Nothing sleeps;
/// seconds of a session pass as fast as they can be computed.
///
/// Work beside the loop is done by tick(), on the test's thread, before the tick at whose time it is due.
class ScriptedPace final : public runtime::Pace {
 public:
  explicit ScriptedPace(double rate_hz);
  /// Ends a loop that still runs; what it throws is lost.
  ~ScriptedPace() override;
  ScriptedPace(const ScriptedPace&) = delete;
  ScriptedPace& operator=(const ScriptedPace&) = delete;

  // ---- the test's thread

  /// Starts `loop`, which is over when it returns or throws, and lets it come to its first wait().
  void run(std::function<void()> loop);
  /// Ticks, each one period after the one before it. False: the loop has ended.
  bool tick(int count = 1);
  /// As many ticks as are due in that time.
  bool pass(double seconds);
  /// Stops the loop, if it does not end by itself, and throws what it threw.
  void finish();
  /// Ticks that were woken, and not due by the schedule.
  std::uint64_t woken() const { return woken_; }

  // ---- any thread while the other one waits

  /// The process stands still for so long, or a tick takes so long: no tick, no work beside it.
  void stall(std::int64_t ns) { now_ns_ += ns; }

  void log_to(runtime::LoopObserver& log) override { log_ = &log; }
  Cause wait() noexcept override;
  void finish_tick() noexcept override;
  void wake() noexcept override { wakes_ = true; }
  void stop() noexcept override { stopped_ = true; }
  std::unique_ptr<runtime::SideWork> beside(std::chrono::milliseconds pause,
                                            std::function<void()> work) override;
  std::unique_ptr<runtime::WokenWork> on_wake(std::function<void()> work) override;
  const runtime::LoopRecord& record() const override { return account_.record(); }
  std::int64_t now_ns() const noexcept override { return now_ns_; }

 private:
  class Chore;
  void hand_over();

  std::int64_t period_ns_;
  runtime::TickAccount account_;
  runtime::LoopObserver* log_ = nullptr;
  std::vector<Chore*> chores_;
  Cause cause_ = Cause::kSchedule;
  std::uint64_t woken_ = 0;
  std::atomic<std::int64_t> now_ns_{1'000'000'000'000};  // the machine is up for a while
  std::atomic<bool> wakes_{false}, stopped_{false};
  bool ended_ = true;
  std::exception_ptr failure_;
  std::binary_semaphore go_{0}, came_{0};  // whose turn it is
  std::thread thread_;
};

}  // namespace omentum::test
