// Which frames become pictures on disk.
#pragma once

#include "render_node/renderer.h"

#include <string>

namespace omentum::render {

/// What should be written of a frame.
struct PicturesDue {
  std::string numbered;  // frame_0001.png, ... of the ordinary view; empty: none
  bool indent = false;   // indent.png, the close-up of the deepest dent
};

/// A numbered picture every period, and the close-up whenever a dent is deeper than in any picture before. No
/// clock: times are given. One thread.
class PictureSchedule {
 public:
  /// period_s <= 0: no numbered frames.
  explicit PictureSchedule(double period_s) : period_s_(period_s) {}

  /// `dent_m`: depth of the deepest dent in this frame (dent.h). Times must not decrease.
  PicturesDue due(double time_s, double dent_m);
  /// What a frame with pictures cost, s.
  void took(double cost_s) { dear_ = dear_ || cost_s > kDear_s; }
  /// Of the picture of that name: where fine ones are dear, numbered ones are plain.
  Quality quality(const std::string& name) const;

 private:
  // A program that draws takes this from the organ, which then falls behind the clock.
  static constexpr double kDear_s = 0.6;

  bool frame_due(double time_s) const;
  bool indent_due(double time_s, double dent_m) const;

  double period_s_;
  int frames_ = 0;
  double next_s_ = 0;
  double indent_m_ = 0;  // in indent.png
  double indent_written_s_ = 0;
  bool dear_ = false;
};

}  // namespace omentum::render
