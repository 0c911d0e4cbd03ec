// The largest force that each hand felt since the session began.
#pragma once

#include "transport/messages.h"

#include <array>
#include <atomic>

namespace omentum::render {

/// Counts every sample that comes, not only those that a frame shows: a peak may last a few milliseconds.
/// Samples come on one thread, any may ask.
class ForcePeaks {
 public:
  /// A sample beyond `most_n` is none (plausible.h); before this is called none is.
  void believe_up_to(double most_n) noexcept { most_n_.store(most_n, std::memory_order_relaxed); }
  void take(const msg::ToolForce& force) noexcept;
  /// Of one tool, N.
  double peak_n(std::uint32_t tool) const noexcept {
    return tool < peaks_n_.size() ? peaks_n_[tool].load(std::memory_order_relaxed) : 0;
  }

 private:
  std::atomic<double> most_n_{0};
  std::array<std::atomic<double>, msg::MAX_TOOLS> peaks_n_{};
};

}  // namespace omentum::render
