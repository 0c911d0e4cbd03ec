// How fine and how often to draw, so that pictures never cost the 1 kHz loop its time.
#pragma once

#include "render_node/renderer.h"

#include <cstdint>

namespace omentum::render {

/// Chooses the quality of the next frame from what the last ones cost, and when it may begin. A graphics card
/// draws kFine at the full rate; software OpenGL on a shared core ends at a coarser quality or a lower rate.
/// Pictures for the disk are always kFine and do not count. No clock: times are given. One thread.
class FrameRateControl {
 public:
  /// `most_fps`: never more. `duty`: the share of the time that drawing may take.
  FrameRateControl(double most_fps, double duty) : period_s_(1 / most_fps), duty_(duty) {}

  Quality quality() const { return quality_; }
  /// Whether a frame may begin now, or within what a pace of the same rate jitters.
  bool due(double now_s) const { return now_s >= next_s_ - kJitter * period_s_; }
  /// What an ordinary frame of quality() cost.
  void record(double begin_s, double cost_s);

 private:
  static constexpr double kJitter =
      0.1;  // of a period: without it, a tick a little early would cost a whole frame

  double period_s_;
  double duty_;
  Quality quality_ = Quality::kCoarse;  // a slow machine must not begin with its slowest frames
  double cost_s_ = 0;                   // smoothed, of this quality
  int frames_ = 0;                      // of this quality
  double next_s_ = 0;
};

}  // namespace omentum::render
