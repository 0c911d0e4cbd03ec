// A folding tube, swept by brute force and skinned on adaptive frames, side by side (Raghupathi 2004, fig.
// 11).
#pragma once

#include "render_node/tube_resolution.h"

#include <filesystem>

namespace omentum::render::trial {

struct CompareCommand {
  std::filesystem::path picture;  // empty: none
  int masses = 100, frames = 60;
  double folded = 1;  // at the animation's end (folding_axis())
  TubeResolution resolution;
  bool folds = false;  // right: coloured by its folds (fig. 10)
};

/// Folds the tube, prints what either way costs and, where it is wanted, draws both. Throws DisplayError
/// where nothing can be drawn, std::runtime_error where the picture cannot be written.
void compare(const CompareCommand& command);

}  // namespace omentum::render::trial
