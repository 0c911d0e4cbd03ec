// Every tick of a loop as one line of a CSV file (--log).
#pragma once

#include "runtime/sample_log.h"

#include <cstdint>
#include <filesystem>

namespace omentum::runtime {

/// One tick. `cause` is Pace::Cause as a number: 0 schedule, 1 woken.
struct LoopSample {
  std::int64_t start_ns = 0;   // steady clock
  std::int64_t period_ns = 0;  // since the start of the tick before, 0 at the first
  std::int64_t compute_ns = 0;
  std::int32_t cause = 0;
};

/// What a Pace tells of each of its ticks.
class LoopObserver {
 public:
  virtual ~LoopObserver() = default;
  /// The loop's thread. Neither waits nor allocates.
  virtual void push(const LoopSample& sample) noexcept = 0;
};

/// Lines `tick,start_ns,period_ns,compute_ns,cause`. Give it to Pace::log_to.
class LoopLog : public LoopObserver {
 public:
  static constexpr const char* kColumns = "tick,start_ns,period_ns,compute_ns,cause";

  /// Throws std::runtime_error when `file` cannot be written.
  explicit LoopLog(const std::filesystem::path& file);
  void push(const LoopSample& sample) noexcept override { samples_.push(sample); }
  /// SampleLog::finish.
  void finish() { samples_.finish(); }

 private:
  SampleLog<LoopSample> samples_;
};

/// The values of kColumns, without an end of line.
void write_columns(std::ostream& out, std::uint64_t tick, const LoopSample& sample);

}  // namespace omentum::runtime
