// The one clock of a process, and the seam that puts another in its place.
#pragma once

#include <cstdint>
#include <ctime>

namespace omentum::runtime {

/// CLOCK_MONOTONIC, ns. Any thread.
inline std::int64_t steady_now_ns() noexcept {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
}

/// A steady time. A node reads it here, so that a test can let it pass.
class Clock {
 public:
  virtual ~Clock() = default;
  /// ns. Any thread; never waits.
  virtual std::int64_t now_ns() const noexcept = 0;
};

}  // namespace omentum::runtime
