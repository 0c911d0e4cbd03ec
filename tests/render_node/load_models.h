// What pictures of a level cost on machines whose narrowest place is the processor, the vertices or the
// pixels, and a session in which the frame-rate control meets them. Simulated time.
#pragma once

#include "render_node/frame_rate_control.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace omentum::render::test {

/// Seconds of a frame: a fixed part, and one for each piece of a tube of 100 masses, each thousand vertices,
/// each million pixels (times what shading them costs).
struct LoadModel {
  double fixed_s = 0, per_piece_s = 0, per_thousand_vertices_s = 0, per_million_pixels_s = 0;

  /// Most bends of a gut are slight; those above eps are parted in three.
  static double pieces(const PictureLevel& level) { return 100 * (1 + 2 * std::pow(1 - level.eps(), 4)); }
  static double vertices(const PictureLevel& level) { return pieces(level) * 12 * std::exp2(level.n() + 1); }
  static double pixels(const PictureLevel& level) {
    constexpr std::array<double, kShadingCount> kShare{1, 0.4, 0.3, 0.08};
    const QualityMeans& means = means_of(level.quality());
    return 0.92 * means.scale * means.scale * kShare[static_cast<std::size_t>(means.shading)];
  }
  double cost_s(const PictureLevel& level) const {
    return fixed_s + per_piece_s * pieces(level) + 1e-3 * per_thousand_vertices_s * vertices(level) +
           per_million_pixels_s * pixels(level);
  }
  /// The same machine, so much slower.
  LoadModel times(double factor) const {
    return {factor * fixed_s, factor * per_piece_s, factor * per_thousand_vertices_s,
            factor * per_million_pixels_s};
  }
};

inline constexpr PictureLevel kCoarsestLevel{};
inline constexpr PictureLevel kFinestLevel{kFinestStep};

struct FrameSeen {
  double begin_s;
  PictureLevel level;
};

class RateSession {
 public:
  RateSession(double fps, double duty) : control_(fps, duty) {}

  /// `noise`: of each cost, its standard deviation as a share.
  void run(const LoadModel& load, double seconds, double noise = 0) {
    std::normal_distribution<double> varies(1, noise);
    for (const double end_s = now_s_ + seconds; now_s_ < end_s;) {
      if (!control_.due(now_s_)) {
        now_s_ += kTick_s;
        continue;
      }
      const double cost_s =
          load.cost_s(control_.level()) * (noise > 0 ? std::max(0.5, varies(generator_)) : 1);
      seen_.push_back({now_s_, control_.level()});
      control_.record(now_s_, cost_s);
      now_s_ += cost_s;
    }
  }
  /// Frames a second between two moments.
  double rate(double from_s, double to_s) const {
    return static_cast<double>(std::ranges::count_if(
               seen_, [&](const FrameSeen& f) { return f.begin_s >= from_s && f.begin_s < to_s; })) /
           (to_s - from_s);
  }
  /// After `from_s`, when every second that follows has `share` of `fps`, but for the frames that one refused
  /// trial costs.
  double settled_s(double from_s, double fps, double share) const {
    constexpr double kTrialFrames = 3;
    double settled = from_s;
    for (double t = from_s; t + 1 <= now_s_; t += 1 / fps)
      if (rate(t, t + 1) < share * fps - kTrialFrames) settled = t + 1 / fps;
    return settled - from_s;
  }
  double now_s() const { return now_s_; }
  const FrameRateControl& control() const { return control_; }

 private:
  static constexpr double kTick_s = 1e-3;
  FrameRateControl control_;
  double now_s_ = 0;
  std::vector<FrameSeen> seen_;
  std::mt19937 generator_{1};
};

}  // namespace omentum::render::test
