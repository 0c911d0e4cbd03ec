// A tube at both ends of the frame rate's control (Raghupathi 2004, fig. 12).
#pragma once

#include <filesystem>

namespace omentum::render::trial {

struct LevelsCommand {
  std::filesystem::path picture;
  int masses = 100, frames = 60;
  double folded = 1;  // at the animation's end (folding_axis())
};

/// Folds the tube as coarsely and as finely as the control may choose (tube_resolution.h), prints what a
/// frame of either takes and writes the last one of both, coarse on the left. Throws as compare().
void show_levels(const LevelsCommand& command);

}  // namespace omentum::render::trial
