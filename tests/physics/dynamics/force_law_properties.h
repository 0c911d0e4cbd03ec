// What every force law must hold to, as functions that a law's own test calls.
#pragma once

#include "physics/dynamics/force_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace omentum::test {

using Values = std::vector<double>;

inline Values random_values(std::size_t count, double size, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, size);
  Values values(count);
  std::ranges::generate(values, [&] { return normal(generator); });
  return values;
}

inline Values forces_of(physics::ForceLaw& law, const Values& u) {
  Values f(u.size());
  law.forces(u, f);
  return f;
}

inline double dot(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

inline double norm(const Values& a) {
  return std::sqrt(dot(a, a));
}

/// a + scale b.
inline Values sum(const Values& a, double scale, const Values& b) {
  Values out(a);
  for (std::size_t i = 0; i < a.size(); ++i) out[i] += scale * b[i];
  return out;
}

/// Along random directions d, from `u`: E(u + h d) - E(u - h d) = -2 h f(u) . d. `step_m`: h times the
/// typical component of d; `tolerance`: of h |f| |d|.
inline void expect_force_is_minus_gradient(physics::ForceLaw& law, const Values& u, double step_m,
                                           double tolerance) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Values d = random_values(u.size(), step_m, seed);
    const Values f = forces_of(law, u);
    const double change = law.energy(sum(u, 1, d)) - law.energy(sum(u, -1, d));
    EXPECT_NEAR(change / 2, -dot(f, d), tolerance * norm(f) * norm(d)) << "direction " << seed;
  }
}

/// Where the forces vanish, as under rigid motions: below `tolerance` of |f| under random displacements of
/// the same size.
inline void expect_no_force(physics::ForceLaw& law, const Values& u, double tolerance) {
  const double size = norm(u) / std::sqrt(static_cast<double>(u.size()));
  EXPECT_LE(norm(forces_of(law, u)), tolerance * norm(forces_of(law, random_values(u.size(), size, 3))));
}

/// The forces add up to nothing: below `tolerance` of the sum of their sizes.
inline void expect_momentum_is_kept(physics::ForceLaw& law, const Values& u, double tolerance) {
  const Values f = forces_of(law, u);
  double sizes = 0;
  for (const double component : f) sizes += std::abs(component);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double total = 0;
    for (std::size_t i = axis; i < f.size(); i += 3) total += f[i];
    EXPECT_LE(std::abs(total), tolerance * sizes) << "axis " << axis;
  }
}

}  // namespace omentum::test
