// How often one tool's poses come.
#pragma once

#include <array>
#include <cstdint>

namespace omentum::haptic {

/// A running estimate: the median of the newest intervals between arrivals, so that a burst, a lost sample or
/// a pause does not count. Reads no clock. One thread.
class PoseInterval {
 public:
  static constexpr int kWindow = 9;  // a change of rate is taken over after five poses
  static constexpr int kEnough = 3;  // fewer say nothing

  void add(std::int64_t arrival_ns) noexcept;
  /// Another device, which has its own rate: its first pose arrived.
  void restart(std::int64_t arrival_ns) noexcept;

  /// 0: not known yet.
  double seconds() const noexcept;
  /// Whether the whole window was heard: what is said of a device then is no matter of its first poses.
  bool is_settled() const noexcept { return count_ == kWindow; }

 private:
  std::array<std::int64_t, kWindow> intervals_ns_{};
  int count_ = 0, next_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace omentum::haptic
