// A step of co-rotational tissue that one linearization is not exact enough for: Newton's method, and a
// search along its directions.
#include "physics/dynamics/warped_step.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {

namespace {

constexpr int kMostRounds = 12;
constexpr double kLeastShare = 1.0 / 64;  // of a direction; below, the law has a kink there

}  // namespace

// Up to a constant, what a step of backward Euler makes least, J,
//   E(u + dt v') + |v' - v|^2_M / 2 + dt (a |v'|^2_M + b |v'|^2_K) / 2 - dt f.v',
// with the warped K as it was linearized last; and the energy there, less the work.
WarpedStep::Potential WarpedStep::potential(std::span<const double> v_before,
                                            std::span<const double> external) noexcept {
  const double dt = options_.step_s, a = inertia_.mass_damping_per_s, b = inertia_.stiffness_damping_s;
  for (std::size_t c = 0; c < turned_.size(); ++c) turned_[c] = again_.u[c] + dt * again_.v[c];
  const double elastic_j = elastic_energy(turned_);
  Potential found{.least_j = elastic_j, .own_j = elastic_j};
  law_.product(again_.v, product_);
  added_.add_product(1, again_.v, product_);
  linear_.add_product(1, again_.v, product_);
  for (std::size_t c = 0; c < turned_.size(); ++c) {
    const double kg = carried_.kg()[c / 3], v = again_.v[c], change = v - v_before[c];
    const double work_j = dt * v * external[c];
    found.least_j += kg * (change * change + dt * a * v * v) / 2 + dt * b * v * product_[c] / 2 - work_j;
    found.own_j += kg * v * v / 2 - work_j;
  }
  return found;
}

// So much of `change` as makes the potential less, and the body's own energy no more than `most_j`; false:
// none does.
bool WarpedStep::go_along(std::span<const double> v_before, std::span<const double> external,
                          double most_j) noexcept {
  const Potential before = potential(v_before, external);
  double gone = 0;
  for (double share = 1; share >= kLeastShare; share /= 2) {
    for (std::size_t c = 0; c < change_.size(); ++c) again_.v[c] += (share - gone) * change_[c];
    gone = share;
    const Potential now = potential(v_before, external);
    if (now.own_j <= most_j && now.least_j < before.least_j) return true;
  }
  for (std::size_t c = 0; c < change_.size(); ++c) again_.v[c] -= gone * change_[c];
  return false;
}

// From a standstill, where the body has no more energy than it had: nor has it, but for the work, in the end.
bool WarpedStep::step_again(BodyState& state, std::span<const double> external) noexcept {
  std::ranges::copy(state.u, again_.u.begin());
  std::ranges::fill(again_.v, 0.0);
  const double most_j = elastic_energy(again_.u) + kinetic_energy(carried_.kg(), state.v);
  double enough = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    linearize(again_);
    double lacking2 = 0;
    for (std::size_t c = 0; c < lacking_.size(); ++c) {
      const double late = carried_.kg()[c / 3] * (state.v[c] - again_.v[c]);
      lacking_[c] = is_held(c) ? 0.0 : late + options_.step_s * (external[c] + forces_[c]);
      lacking2 += lacking_[c] * lacking_[c];
    }
    if (round == 0) enough = enough_of(lacking_);
    if (round > 0 && lacking2 <= enough * enough) break;
    std::ranges::fill(change_, 0.0);
    if (!solve(enough_of(lacking_), lacking_, change_) || !go_along(state.v, external, most_j)) break;
  }
  is_linear_ = false;
  std::ranges::fill(residual_, 0.0);
  double speed2 = 0;
  for (std::size_t c = 0; c < change_.size(); ++c) {
    state.v[c] = again_.v[c];
    state.u[c] += options_.step_s * state.v[c];
    speed2 += state.v[c] * state.v[c];
  }
  return std::isfinite(speed2);
}

}  // namespace omentum::physics
