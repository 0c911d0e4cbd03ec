// Whether this process stood still for so long that others forgot it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace omentum::transport {

/// Finds standstills in the times of regular looks. Reads no clock. One thread.
class Standstill {
 public:
  /// longest: what may pass between two looks of a process that runs.
  explicit Standstill(std::chrono::nanoseconds longest) : longest_ns_(longest.count()) {}

  /// Whether longer than `longest` passed since the look before. now_ns: on a clock that goes on while the
  /// process or the machine sleeps.
  bool found(std::int64_t now_ns) noexcept {
    const bool found = last_ns_ && now_ns - *last_ns_ > longest_ns_;
    last_ns_ = now_ns;
    return found;
  }

 private:
  std::int64_t longest_ns_;
  std::optional<std::int64_t> last_ns_;
};

/// A thread that looks often, and acts once the process goes on after a standstill: a stopped process, a
/// suspended machine.
class StandstillWatch {
 public:
  /// `act` runs on the watch's thread, which has the scheduling of the one that makes the watch. It must not
  /// throw; when it returns false it is asked again at the next look.
  StandstillWatch(std::chrono::nanoseconds longest, std::function<bool()> act);
  /// Waits for a running `act`.
  ~StandstillWatch() = default;
  StandstillWatch(const StandstillWatch&) = delete;
  StandstillWatch& operator=(const StandstillWatch&) = delete;

 private:
  void watch(const std::stop_token& stop);

  Standstill standstill_;
  std::function<bool()> act_;
  std::mutex mutex_;  // nobody else's: a condition wants one
  std::condition_variable_any wait_;
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace omentum::transport
