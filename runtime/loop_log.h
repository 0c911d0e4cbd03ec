// Every tick of a loop as one line of a CSV file (--log).
#pragma once

#include "runtime/sample_log.h"

#include <cstdint>
#include <filesystem>

namespace omentum::runtime {

/// One tick. `cause` is RateLoop::Cause as a number: 0 schedule, 1 woken.
struct LoopSample {
  std::int64_t start_ns = 0;   // steady clock
  std::int64_t period_ns = 0;  // since the start of the tick before, 0 at the first
  std::int64_t compute_ns = 0;
  std::int32_t cause = 0;
};

/// Lines `tick,start_ns,period_ns,compute_ns,cause`. Give it to RateLoop::log_to.
class LoopLog : public SampleLog<LoopSample> {
 public:
  /// Throws std::runtime_error when `file` cannot be written.
  explicit LoopLog(const std::filesystem::path& file);
};

}  // namespace omentum::runtime
