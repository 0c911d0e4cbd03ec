// How fine a picture is drawn: each of its means as a ladder of steps, from the coarsest up.
#pragma once

#include "render_node/picture_quality.h"

#include <array>
#include <string>

namespace omentum::render {

/// What a picture can spend on.
enum Mean : std::size_t {
  kIntervals,  // into how many pieces a tube's axis is parted: the processor's work (Raghupathi 2004: eps)
  kSections,   // of a tube's cylinder: vertices (Raghupathi 2004: n)
  kPixels,     // how many, and how each is lit (picture_quality.h)
};
inline constexpr std::size_t kMeanCount = 3;
inline constexpr std::array<int, kMeanCount> kFinestStep{5, 5, static_cast<int>(kQualityCount) - 1};

/// Steps from 0, the coarsest, to kFinestStep.
struct PictureLevel {
  std::array<int, kMeanCount> step{};

  Quality quality() const { return static_cast<Quality>(kFinestStep[kPixels] - step[kPixels]); }
  /// Above this curvature, (1 - cos) / 2 of the bend at a point of the axis, a piece of a tube is parted.
  double eps() const;
  /// A piece of a tube has 2^(n + 1) sections.
  int n() const { return step[kSections]; }

  friend bool operator==(const PictureLevel&, const PictureLevel&) = default;
};

/// "draft, eps 0.10, n 3".
std::string words(const PictureLevel& level);

}  // namespace omentum::render
