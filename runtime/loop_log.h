// Every tick of a loop as one line of a CSV file (--log).
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace omentum::runtime {

/// One tick. `cause` is RateLoop::Cause as a number: 0 schedule, 1 woken.
struct LoopSample {
  std::int64_t start_ns = 0;   // steady clock
  std::int64_t period_ns = 0;  // since the start of the tick before, 0 at the first
  std::int64_t compute_ns = 0;
  std::int32_t cause = 0;
};

/// A ring between the loop, which never waits, and a thread that writes
/// `tick,start_ns,period_ns,compute_ns,cause` lines four times a second. Samples that find the ring full (a
/// disk that stood still for more than a minute at 1 kHz) are dropped and counted in a last line "# dropped
/// N".
class LoopLog {
 public:
  /// Throws std::runtime_error when `file` cannot be written.
  explicit LoopLog(const std::filesystem::path& file);
  /// Writes what is left.
  ~LoopLog();
  LoopLog(const LoopLog&) = delete;
  LoopLog& operator=(const LoopLog&) = delete;

  /// The loop's thread. Neither waits nor allocates.
  void push(const LoopSample& sample) noexcept;

 private:
  struct Drain;
  static constexpr std::uint64_t kCapacity = 1 << 16;  // 65 s at 1 kHz

  std::vector<LoopSample> ring_;
  std::atomic<std::uint64_t> written_{0};  // by the loop
  std::atomic<std::uint64_t> drained_{0};  // by the thread
  std::atomic<std::uint64_t> dropped_{0};
  std::unique_ptr<Drain> drain_;
};

}  // namespace omentum::runtime
