// How different two pictures look to a person.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render::test {

/// CIE 1976 colour differences (Delta E*ab, D65) of pictures that were blurred a little first, in linear
/// light: grain, and an edge that another rasterizer moves by a part of a pixel, are not seen.
struct SeenDifference {
  double mean = 0;
  double worst = 0;  // of all pixels but a hundredth
};

/// Two colours side by side are just told apart at 2.3 (Mahy, Van Eycken, Oosterlinck 1994). A picture is the
/// same where even its worst places differ by less, and it as a whole by a quarter of that.
inline constexpr double kJustSeen = 2.3, kSameWorst = kJustSeen, kSameMean = 0.25 * kJustSeen;

/// Both of one size. Infinite where they are not.
SeenDifference seen_difference_of(const Picture& a, const Picture& b);

inline bool looks_same(const SeenDifference& d) {
  return d.mean < kSameMean && d.worst < kSameWorst;
}

}  // namespace omentum::render::test
