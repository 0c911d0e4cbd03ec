// When a loop that is woken by several devices ticks.
#pragma once

#include <cstdint>

namespace omentum::runtime {

/// The pacing rule of RateLoop, on given times; it reads no clock. One thread.
///
/// Wakes of one device period come as a burst: two tools' poses, sent back to back, arrive some 20-100 us
/// apart. The gate learns how many wakes make a burst and opens at the last of them, so that
/// - one tool's pose is served at once;
/// - two tools' poses of the same period are served by one tick, that starts when the second one arrives;
/// - no pose waits longer than `window` (a tool that fell silent costs one such wait, then the burst is
///   smaller again), and a wake that comes after the gate opened is served by a tick of its own.
/// Devices out of step with each other are each served at once. Without a wake the gate opens `grace`
/// after the last woken tick and then every period, against absolute time.
class WakeGate {
 public:
  /// window: an eighth of the period but at most 150 us: several times the spacing of two poses of a burst,
  /// and still small beside a period. grace: 1.5 periods: late enough that a device at the nominal rate is
  /// waited for, early enough that a period that brings no pose still brings a tick (a gap of 2 periods would
  /// count as a miss).
  explicit WakeGate(std::int64_t period_ns);

  enum class Open { kNo, kWoken, kSchedule };

  /// Asks at `now_ns`, with `wakes` so far in all, the last of them at `last_wake_ns`. When the gate is
  /// open, all these wakes are served.
  Open poll(std::uint32_t wakes, std::int64_t last_wake_ns, std::int64_t now_ns) noexcept;

  /// When to ask again if no further wake comes.
  std::int64_t ask_again_ns() const { return ask_again_ns_; }

 private:
  Open open_woken(std::uint32_t wakes, std::int64_t now_ns) noexcept;
  Open poll_schedule(std::int64_t now_ns) noexcept;

  std::int64_t period_ns_, window_ns_, grace_ns_;
  std::int64_t due_ns_ = 0;  // the next tick of the schedule
  std::int64_t ask_again_ns_ = 0;
  std::int64_t burst_begin_ns_;   // when the newest burst's first wake was seen
  std::uint32_t served_ = 0;      // wakes in all when the gate opened last
  std::uint32_t burst_size_ = 1;  // wakes expected in a burst
  bool begun_ = false;            // the schedule has an origin
  bool gathering_ = false;        // a burst has begun and is not complete
};

}  // namespace omentum::runtime
