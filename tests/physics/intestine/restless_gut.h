// A gut to collide with, and motions that shake it.
#pragma once

#include "geometry/gut_anatomy.h"
#include "physics/intestine/gut_state.h"

#include <random>

namespace omentum::test {

/// The paper's, without overlaps.
inline geometry::GutShape folded_gut(std::int32_t columns = 100) {
  geometry::GutAnatomy anatomy;
  anatomy.columns = columns;
  return geometry::make_gut(anatomy);
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
