// The one clock of a process.
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

}  // namespace omentum::runtime
