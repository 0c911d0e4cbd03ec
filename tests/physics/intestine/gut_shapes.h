// Guts for tests: shapes that need no generator.
#pragma once

#include "geometry/gut_shape.h"

#include <cmath>
#include <numbers>
#include <random>

namespace omentum::test {

/// A gut of `length_m` that hangs in an arc of waves under a short vessel along x, its mesentery `width_m`
/// wide in the middle and without width at both ends.
inline geometry::GutShape hanging_gut(geometry::GutLayout layout, double length_m = 4, double width_m = 0.15,
                                      double vessel_m = 0.1) {
  geometry::GutShape shape{layout, {}, 0.02, 0.01};
  shape.positions.resize(static_cast<std::size_t>(layout.mass_count()));
  const auto axis = [&](double s) {  // waves of the gut sideways, so that 4 m fit over the vessel's 0.1 m
    const double swell = std::min(1.0, 8 * std::min(s, 1 - s));
    const double wave = 2 * std::numbers::pi * 8 * s;
    const double side = 0.05 * length_m / 4 * swell * std::sin(wave);
    return geometry::Vec3(vessel_m * (s - 0.5) + 0.05 * length_m / 4 * swell * (s - 0.5) * 6, side,
                          -width_m * swell);
  };
  for (std::int32_t c = 0; c < layout.columns; ++c) {
    const double s = static_cast<double>(c) / (layout.columns - 1);
    const geometry::Vec3 at_vessel(vessel_m * (s - 0.5), 0, 0);
    for (std::int32_t r = 0; r < layout.rows; ++r) {
      const double down = 1 - static_cast<double>(r) / (layout.rows - 1);
      shape.positions[static_cast<std::size_t>(layout.mass(r, c))] = at_vessel + down * (axis(s) - at_vessel);
    }
  }
  return shape;
}

/// The shape with every free mass moved by normal deviates of `size_m`.
inline std::vector<geometry::Vec3> shaken(const geometry::GutShape& shape, double size_m, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, size_m);
  std::vector<geometry::Vec3> x = shape.positions;
  for (std::int32_t m = 0; m < shape.layout.mass_count(); ++m) {
    const geometry::Vec3 way(normal(generator), normal(generator), normal(generator));
    if (!shape.layout.is_held(geometry::MassId(m))) x[static_cast<std::size_t>(m)] += way;
  }
  return x;
}

}  // namespace omentum::test
