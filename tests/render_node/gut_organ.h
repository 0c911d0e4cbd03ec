// A gut for the tests: loops in a plane over a fan of mesentery.
#pragma once

#include "geometry/gut_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render::test {

/// A curve whose direction swings from side to side (a meander, Langbein and Leopold 1966), `length_m` long,
/// at height z; the vessel is 10 cm in the middle below it. All of the first and last column is on its masses
/// of the axis.
inline geometry::GutShape gut_shape(std::int32_t columns = 100, double length_m = 1.6,
                                    double radius_m = 0.012) {
  constexpr double kSwing_rad = 1.9, kPeriod_m = 0.4, kHeight_m = 0.06;
  geometry::GutShape gut{{4, columns}, {}, radius_m, 0.01};
  std::vector<geometry::Vec3> axis{{0, 0, kHeight_m}};
  const int fine = 40;  // steps of each segment
  const double step = length_m / ((columns - 1) * fine);
  geometry::Vec3 p = axis.front();
  for (int i = 1; i < columns; ++i) {
    for (int k = 0; k < fine; ++k) {
      const double s = ((i - 1) * fine + k + 0.5) * step;
      const double angle = kSwing_rad * std::cos(2 * std::numbers::pi * s / kPeriod_m);
      p += step * geometry::Vec3(std::cos(angle), std::sin(angle), 0);
    }
    axis.push_back(p);
  }
  const geometry::Vec3 middle(0.5 * p.x(), 0, 0);
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; i < columns; ++i) {
      const bool end = i == 0 || i == columns - 1;
      const geometry::Vec3 vessel = middle + geometry::Vec3(0.1 * (i / (columns - 1.0) - 0.5), 0, 0);
      const double away = end ? 0 : row / 3.0;
      gut.positions.push_back((1 - away) * axis[static_cast<std::size_t>(i)] + away * vessel);
    }
  }
  return gut;
}

}  // namespace omentum::render::test
