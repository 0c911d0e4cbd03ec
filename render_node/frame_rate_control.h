// How fine and how often to draw, so that pictures keep their rate and never cost the 1 kHz loop its time.
#pragma once

#include "render_node/picture_level.h"

#include <array>
#include <cstdint>
#include <optional>

namespace omentum::render {

/// The share of the time that drawing may take. The 1 kHz loops' priority takes the processor from it at any
/// moment; the rest is for what has none.
inline constexpr double kDrawingDuty = 0.75;

/// Chooses the level of the next frame from what the last ones cost, and when it may begin: the feedback of
/// Raghupathi 2004, eq. 15, over all means of a picture at once (picture_level.h). From frame to frame
///
///     x_m += (alpha f0^2) ln(f_k / f0) / f0   of each mean's ladder,   alpha = 4 / f0^2,
///
/// 0 its coarsest and 1 its finest step: with eps = 1 - x_eps that is eq. 15 to first order in f_k - f0 (the
/// logarithm neither runs away where a frame costs a hundredth, nor creeps where it costs ten times too
/// much), with beta = 5 steps of n over the range of eps and the sign of n turned, as vertices ask for it.
/// Each mean goes on alone when the others are at an end. Near the asked rate the means are tried one by one,
/// one step finer each: what would miss the rate is refused and remembered until a frame costs clearly less;
/// so whichever of processor, vertices and pixels is the narrowest place is as fine as it can be, the others
/// are at their finest, and nothing swings. Pictures for the disk are always kFine and do not count. No
/// clock: times are given. One thread.
class FrameRateControl {
 public:
  /// `most_fps`, f0: asked for, and never more. `duty`: the share of the time that drawing may take.
  FrameRateControl(double most_fps, double duty);

  const PictureLevel& level() const { return level_; }
  Quality quality() const { return level_.quality(); }
  /// Whether a frame may begin now, or within what a pace of the same rate jitters.
  bool due(double now_s) const { return now_s >= next_s_ - kJitter * period_s_; }
  /// What an ordinary frame of level() cost.
  void record(double begin_s, double cost_s);

  double asked_fps() const { return 1 / period_s_; }
  /// With the newest costs.
  double reached_fps() const;
  /// How often the level changed.
  std::uint64_t changes() const { return changes_; }

 private:
  static constexpr double kJitter =
      0.1;  // of a period: without it, a tick a little early would cost a whole frame
  static constexpr std::size_t kJudged = 8;  // frames of a trial
  static constexpr std::size_t kKept = 24;   // frames, for what is nearly right

  /// A step of a mean that missed the rate: by how much it made a frame dearer.
  struct Refusal {
    double growth = 1;
    double until_s = 0;
  };
  void keep(double cost_s);
  double median_s(std::size_t newest) const;
  void judge(double now_s);
  void judge_trial(double median, double now_s);
  void coarsen(double cost_s);
  bool refine_together(double median);
  void refine_one();
  void lift_refusals(double median, double now_s);
  bool too_dear() const;
  bool open(std::size_t mean) const;
  double gain() const;
  void move(std::size_t mean, int step);
  void begin_level();

  double period_s_;
  double most_s_,
      budget_s_;  // that a frame may cost at the asked rate; that one of a new level must not exceed
  PictureLevel level_;
  std::array<double, kMeanCount> x_{};  // of each ladder, in steps: eq. 15's rho
  std::array<std::optional<Refusal>, kMeanCount> refused_;
  std::array<double, kKept> costs_{};
  std::size_t frames_ = 0;            // of this level that were judged
  bool fresh_ = true;                 // the level was just chosen: its first frame makes buffers
  std::optional<std::size_t> trial_;  // the mean that was made finer by one step, and is not accepted yet
  double before_trial_s_ = 0;         // what a frame cost
  bool approved_ = false;             // this level met the budget once: it is kept within the band
  bool careful_ = false;              // all together went too far: one by one from here on
  double next_s_ = 0;
  double cost_s_ = 0;  // of this level, the median
  std::uint64_t changes_ = 0;
};

}  // namespace omentum::render
