// Which frames become pictures on disk.
#pragma once

#include <string>
#include <vector>

namespace omentum::render {

/// Names the files that a frame should be written to: frame_0001.png, ... every period, and indent.png when
/// the organ is pressed deeper than in any picture before. No clock: times are given. One thread.
class PictureSchedule {
 public:
  /// period_s <= 0: no numbered frames.
  explicit PictureSchedule(double period_s) : period_s_(period_s) {}

  /// `deepest_m`: largest displacement in this frame. Times must not decrease.
  std::vector<std::string> due(double time_s, double deepest_m);

 private:
  bool frame_due(double time_s) const;
  bool indent_due(double time_s, double deepest_m) const;

  double period_s_;
  int frames_ = 0;
  double next_s_ = 0;
  double deepest_m_ = 0;  // in indent.png
  double indent_written_s_ = 0;
};

}  // namespace omentum::render
