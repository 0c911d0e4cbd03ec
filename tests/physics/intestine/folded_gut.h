// A gut to collide with, and motions that shake it.
#pragma once

#include "geometry/gut_shape.h"
#include "physics/intestine/gut_state.h"

#include <cmath>
#include <numbers>
#include <random>

namespace omentum::test {

/// Three folds around a cylinder of radius 15 cm whose axis is z, 4 m in all; a mesentery to a vessel of 10
/// cm on that axis. Nothing overlaps but for what the ends of the vessel bring together.
inline geometry::GutShape folded_gut(std::int32_t rows = 4, std::int32_t columns = 100) {
  using std::numbers::pi;
  geometry::GutShape shape{{rows, columns}, {}, 0.02, 0.01};
  shape.positions.resize(static_cast<std::size_t>(shape.layout.mass_count()));
  for (std::int32_t c = 0; c < columns; ++c) {
    const double along = static_cast<double>(c) / (columns - 1);
    const double angle = 2.3 * std::sin(6 * pi * along);
    const double radius = 0.15 * std::min(1.0, 12 * std::min(along, 1 - along));
    const geometry::Vec3 vessel(0, 0, 0.1 * along);
    const geometry::Vec3 gut(radius * std::cos(angle), radius * std::sin(angle), 0.4 * along - 0.15);
    for (std::int32_t r = 0; r < rows; ++r) {
      const double share = static_cast<double>(r) / (rows - 1);
      const bool at_end = c == 0 || c == columns - 1;
      shape.positions[shape.layout.mass(r, c)] =
          at_end ? vessel : geometry::Vec3((1 - share) * gut + share * vessel);
    }
  }
  return shape;
}

/// A vector with components from -size to size, the same on every machine.
inline geometry::Vec3 random_vector(std::mt19937_64& random, double size) {
  const auto number = [&] { return size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1); };
  const double x = number(), y = number(), z = number();
  return {x, y, z};
}

/// What the springs of a very restless gut might want: each free mass at a random velocity for a step.
inline void shake(const geometry::GutLayout& layout, double speed, double step_s, std::mt19937_64& random,
                  physics::GutState& state) {
  for (std::int32_t m = 0; m < layout.mass_count(); ++m) {
    const geometry::MassId mass(m);
    if (layout.is_held(mass)) continue;
    state.v[mass] += random_vector(random, speed);
    state.x[mass] += step_s * state.v[mass];
  }
}

/// At rest at the start.
inline physics::GutState state_of(const geometry::GutShape& shape) {
  return {shape.positions, std::vector<geometry::Vec3>(shape.positions.size(), geometry::Vec3::Zero())};
}

}  // namespace omentum::test
