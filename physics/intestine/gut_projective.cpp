#include "physics/intestine/gut_projective.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {

using geometry::Vec3;

GutProjective::GutProjective(const GutSprings& springs, const GutBand& band, double step_s, int iterations)
    : springs_(springs),
      band_(band),
      step_s_(step_s),
      iterations_(iterations),
      forces_(springs),
      start_(springs.mass().size()),
      loads_(start_.size()),
      x_(start_.size()),
      constant_(start_.size()),
      f_(start_.size()),
      way_(band.size()) {
  const double each = (1 + step_s * springs.drag_per_s()) / (step_s * step_s);
  for (const double m : springs.mass()) inertia_.push_back(each * m);
  for (std::size_t place = 0; place < band.size(); ++place) mass_.push_back(band.mass(place));
}

void GutProjective::step(std::span<const Vec3> forces_n, GutState& state) noexcept {
  begin(forces_n, state);
  for (int k = 0; k < iterations_; ++k) go_downhill();
  x_.give(state.x);
  end({}, state.x, state.v);
}

void GutProjective::begin(std::span<const Vec3> forces_n, GutState& state) noexcept {
  x_.take(state.x);
  energy_j_ = kinetic_energy(springs_, state.v) + forces_.measure(x_);
  forces_.begin_step(step_s_);
  std::ranges::copy(forces_n, loads_.begin());
  start_ = state.x;
  constant_.take(forces_n);
  for (std::size_t i = 0; i < start_.size(); ++i) {
    const Vec3 carried = springs_.mass()[i] / step_s_ * state.v[i] + inertia_[i] * start_[i];
    constant_.add(i, carried.data());
    state.x[i] += step_s_ * state.v[i];
  }
  x_.take(state.x);
}

void GutProjective::find_residual() noexcept {
  kernels::begin_forces(inertia_.size(), constant_.planes(), inertia_.data(), x_.planes(), f_.planes());
  forces_.add_implicit(x_, f_);
}

void GutProjective::go_downhill() noexcept {
  find_residual();
  for (std::size_t place = 0; place < way_.size(); ++place)
    f_.get(static_cast<std::size_t>(mass_[place]), way_[place].v);
  band_.solve(way_.data());
  for (std::size_t place = 0; place < way_.size(); ++place)
    x_.add(static_cast<std::size_t>(mass_[place]), way_[place].v);
}

void GutProjective::go_downhill(std::span<const Vec3> pushes_n, std::span<Vec3> x) noexcept {
  x_.take(x);
  find_residual();
  for (std::size_t place = 0; place < way_.size(); ++place) {
    const auto m = static_cast<std::size_t>(mass_[place]);
    Eigen::Map<Vec3>(way_[place].v) = f_.at(m) + pushes_n[m];
  }
  band_.solve(way_.data());
  for (std::size_t place = 0; place < way_.size(); ++place)
    x[static_cast<std::size_t>(mass_[place])] += Eigen::Map<const Vec3>(way_[place].v);
}

void GutProjective::end(std::span<const Vec3> pushes_n, std::span<const Vec3> x, std::span<Vec3> v) noexcept {
  for (std::size_t i = 0; i < start_.size(); ++i) v[i] = (x[i] - start_[i]) / step_s_;
  x_.take(x);
  keep_energy(pushes_n, x, v);
}

// The few iterations leave slow modes short of where the step would take them: what they then have too much,
// and neither loads nor pushes gave, is taken from all velocities alike.
void GutProjective::keep_energy(std::span<const Vec3> pushes_n, std::span<const Vec3> x,
                                std::span<Vec3> v) noexcept {
  double allowed_j = energy_j_ - forces_.measure(x_);
  for (std::size_t i = 0; i < start_.size(); ++i) allowed_j += loads_[i].dot(x[i] - start_[i]);
  for (std::size_t i = 0; i < pushes_n.size(); ++i) allowed_j += pushes_n[i].dot(x[i] - start_[i]);
  const double kinetic_j = kinetic_energy(springs_, v);
  if (kinetic_j <= allowed_j) return;
  const double share = std::sqrt(std::max(0.0, allowed_j / kinetic_j));
  for (Vec3& speed : v) speed *= share;
}

}  // namespace omentum::physics
