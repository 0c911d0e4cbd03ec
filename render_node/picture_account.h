// How long pictures were drawn at which level.
#pragma once

#include "render_node/frame_rate_control.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace omentum::render {

/// Books each frame's time, to the next one, on its quality. No clock: times are given. One thread.
class PictureAccount {
 public:
  /// A frame of that quality began. Times must not decrease.
  void add(Quality quality, double begin_s);

  /// Frames a second, from the first to the newest; 0 before there are two.
  double fps() const;
  /// `level` at the end in words, `asked_fps`, `reached_fps` over the whole session, `changes` of the level,
  /// and `share`: of the time, by quality, those that were drawn.
  nlohmann::json to_json(const FrameRateControl& control) const;

 private:
  std::array<double, kQualityCount> seconds_{};
  Quality newest_{};
  double first_s_ = 0, newest_s_ = 0;
  std::uint64_t frames_ = 0;
};

/// The panel's line: "draft, 28 of 30 Hz"; with (eps, n) where there is a tube: "draft, eps 0.12, n 3, 28 of
/// 30 Hz".
std::string rate_words(const FrameRateControl& control, bool has_tube);

/// What is said once where no graphics card draws: who does, and how.
std::string software_words(const std::string& rasterizer, const FrameRateControl& control);

}  // namespace omentum::render
