// Guts for tests: shapes without folds, and states that are not at rest.
#pragma once

#include "geometry/gut_shape.h"

#include <algorithm>
#include <random>

namespace omentum::test {

/// A curtain: the vessel along x, the gut `width_m` below it, nearer and nearer to it towards both ends.
inline geometry::GutShape curtain(geometry::GutLayout layout, double length_m = 1, double width_m = 0.15) {
  geometry::GutShape shape{layout, {}, 0.02, 0.01};
  shape.positions.resize(static_cast<std::size_t>(layout.mass_count()));
  for (std::int32_t m = 0; m < layout.mass_count(); ++m) {
    const double s = static_cast<double>(layout.column(geometry::MassId(m))) / (layout.columns - 1);
    const double share = static_cast<double>(layout.row(geometry::MassId(m))) / (layout.rows - 1);
    const double width = width_m * std::min(1.0, 4 * std::min(s, 1 - s));
    shape.positions[static_cast<std::size_t>(m)] =
        geometry::Vec3(length_m * (s - 0.5), 0, width * (share - 1));
  }
  return shape;
}

/// Normal deviates of `size` for the masses that are free, zero for those that are held.
inline std::vector<geometry::Vec3> deviates(const geometry::GutLayout& layout, double size,
                                            unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, size);
  std::vector<geometry::Vec3> way;
  for (std::int32_t m = 0; m < layout.mass_count(); ++m) {
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    way.emplace_back(layout.is_held(geometry::MassId(m)) ? geometry::Vec3::Zero() : geometry::Vec3(x, y, z));
  }
  return way;
}

/// The positions of a shape with every free mass moved by deviates of `size_m`.
inline std::vector<geometry::Vec3> shaken(const geometry::GutShape& shape, double size_m, unsigned seed = 1) {
  std::vector<geometry::Vec3> x = shape.positions;
  const std::vector<geometry::Vec3> way = deviates(shape.layout, size_m, seed);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += way[i];
  return x;
}

}  // namespace omentum::test
