// A folded curve of which a polygon of equal sides has a given length.
#pragma once

#include "geometry/gut_curve.h"

#include <optional>
#include <vector>

namespace omentum::geometry {

/// The curve, and the places on it that are the polygon's corners.
struct GutFit {
  GutCurve curve;
  std::vector<double> places;  // [sides + 1], from 0 to curve.length_m()
};

/// Legs so long that `sides` chords of side_m lead from the curve's start to its end, the last one to 1e-10
/// m. `folds.leg_m` is the least that a leg may be. Nothing where the least is too long already.
std::optional<GutFit> fit_legs(GutFolds folds, std::int32_t sides, double side_m);

}  // namespace omentum::geometry
