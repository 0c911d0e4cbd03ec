// How finely a tube may be drawn.
#pragma once

#include "render_node/tube_item.h"

#include <algorithm>
#include <array>

namespace omentum::render {

/// Of n: two sections of a piece, straight between its frames; and 64, as far as eq. 15 is let
/// (picture_level.h); from 16 on nobody sees more.
inline constexpr int kLeastTubeN = 0, kMostTubeN = 5;
/// Of eps: a turn of 90 degrees, and one of 9.
inline constexpr double kCoarsestTubeEps = 0.5, kFinestTubeEps = 0.006;

/// From coarse to fine: each costs more than the one before it. eps first: where the tube is folded it is
/// seen to be coarse first.
inline constexpr std::array<TubeResolution, 7> kTubeLadder{{{kCoarsestTubeEps, 0},
                                                            {0.12, 0},
                                                            {0.12, 1},
                                                            {0.03, 1},
                                                            {0.03, 2},
                                                            {kFinestTubeEps, 2},
                                                            {kFinestTubeEps, 3}}};

/// Of pictures for the disk: the finest that is seen to differ from the next coarser one.
inline constexpr TubeResolution kPictureTube = kTubeLadder.back();

/// Within the bounds.
constexpr TubeResolution clamped(const TubeResolution& wanted) {
  return {std::clamp(wanted.eps, kFinestTubeEps, kCoarsestTubeEps),
          std::clamp(wanted.n, kLeastTubeN, kMostTubeN)};
}

}  // namespace omentum::render
