// Numbers as colours, and back.
#pragma once

#include "organ_tools/force_map/canvas.h"

#include <vector>

namespace omentum::force_map {

/// From dark blue (low) over green to yellow (high): even steps look even, in grey too (after matplotlib's
/// viridis).
struct ColourScale {
  double low = 0, high = 1;

  Colour of(double value) const;
  /// Round numbers within, ascending: about six.
  std::vector<double> ticks() const;
};

}  // namespace omentum::force_map
