// Which frames become pictures on disk.
#pragma once

#include "render_node/renderer.h"

#include <string>

namespace omentum::render {

/// The last picture's file: nothing waits for it any more.
inline constexpr const char* kLastPicture = "final.png";
/// The close-up's of the deepest dent.
inline constexpr const char* kIndentPicture = "indent.png";

/// What should be written of a frame.
struct PicturesDue {
  std::string numbered;  // frame_0001.png, ... of the ordinary view; empty: none
  bool indent = false;   // kIndentPicture, the close-up of the deepest dent
};

/// A numbered picture every period, and the close-up whenever a dent is deeper than in any picture before. No
/// clock: times are given. One thread.
class PictureSchedule {
 public:
  /// period_s <= 0: no numbered frames. `stalls`: a person sees the window stand still while a fine picture
  /// is drawn.
  explicit PictureSchedule(double period_s, bool stalls = false)
      : period_s_(period_s), stalls_(stalls), dear_(stalls) {}

  /// `dent_m`: depth of the deepest dent in this frame (dent.h). Times must not decrease.
  PicturesDue due(double time_s, double dent_m);
  /// What a frame with pictures cost, s.
  void took(double cost_s) { dear_ = dear_ || cost_s > kDear_s; }
  /// Of the picture of that name: the last one is fine whatever it costs; where fine ones are dear, others
  /// are plain, and the close-up, which nobody asked for in this moment, stalls no window.
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
  bool stalls_, dear_;
};

/// `asked_period_s` negative: every 2 s off-screen, none in a window. Where software draws a window, a
/// person would see it stand still while a hand presses: for half a second (fine), or a third (plain).
PictureSchedule schedule_of(double asked_period_s, const Renderer& renderer);

}  // namespace omentum::render
