// Distribution of durations, filled inside a real-time loop.
#pragma once

#include <array>
#include <cstdint>

namespace omentum::runtime {

/// What reports print: microseconds.
struct Percentiles {
  double p50 = 0, p99 = 0, p999 = 0, max = 0;
  std::uint64_t count = 0;
};

/// Log-linear bins from 1 ns to an hour with at most 1.6 % relative width (64 bins an octave). A percentile
/// is the mean of the values in its bin, so that a steady period reads as what it is; max is exact. add() is
/// O(1), allocates nothing and never fails. One thread at a time.
class Histogram {
 public:
  void add_ns(std::int64_t duration_ns) noexcept;  // negative counts as 0
  double percentile_us(double fraction) const;     // 0 when empty
  Percentiles percentiles() const;
  std::uint64_t count() const { return count_; }
  void clear() noexcept;

 private:
  static constexpr int kBinsPerOctave = 64;
  static constexpr int kOctaves = 42;
  struct Bin {
    std::uint32_t count = 0;
    float mean_ns = 0;
  };
  std::array<Bin, kBinsPerOctave * kOctaves> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace omentum::runtime
