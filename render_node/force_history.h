// The force that a hand felt during the last seconds.
#pragma once

#include <cstdint>
#include <vector>

namespace omentum::render {

/// Samples of one tool, oldest first. One thread.
class ForceHistory {
 public:
  static constexpr double kSpan_s = 10;

  struct Sample {
    double time_s = 0;
    float force_n = 0;
    bool after_gap = false;  // nothing was felt before it: no line leads to it
  };
  /// Times must not decrease; what is older than the span is forgotten.
  void add(double time_s, double force_n);
  /// Nothing is felt now: the next sample begins a new line.
  void interrupt() { interrupted_ = true; }
  void clear() { samples_.clear(); }
  const std::vector<Sample>& samples() const { return samples_; }
  float largest_n() const;

 private:
  std::vector<Sample> samples_;
  bool interrupted_ = true;
};

/// The upper end of a force axis that holds `largest_n`: 1, 2 or 5 times a power of ten, at least 1 N.
double force_axis_n(double largest_n);

}  // namespace omentum::render
