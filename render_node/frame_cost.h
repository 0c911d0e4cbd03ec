// What a frame that others delayed counts as.
#pragma once

#include <algorithm>

#include <time.h>

namespace omentum::render {

/// The share of the time that a frame may be on its way, waiting included, where drawing itself takes less
/// than kDrawingDuty (frame_rate_control.h).
inline constexpr double kWaitingDuty = 0.92;

/// The processor's time of this thread, s.
inline double thread_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// For FrameRateControl, whose share of the time is `duty`: the processor's time of a frame, but as much as
/// leaves it kWaitingDuty of the clock's. What the frame waited while others had the processor is no drawing,
/// and pausing for them once more gives them nothing; without that it is the clock's time alone, and frames
/// end before the next begins.
inline double counted_cost_s(double clock_s, double processor_s, double duty) {
  return std::clamp(processor_s, std::min(1.0, duty / kWaitingDuty) * clock_s, clock_s);
}

}  // namespace omentum::render
