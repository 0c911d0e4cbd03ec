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
  for (std::size_t i = 0; i < start_.size(); ++i) state.v[i] = (state.x[i] - start_[i]) / step_s_;
  keep_energy(forces_n, state);
}

void GutProjective::begin(std::span<const Vec3> forces_n, GutState& state) noexcept {
  x_.take(state.x);
  energy_j_ = kinetic_energy(springs_, state.v) + forces_.measure(x_);
  forces_.begin_step(step_s_);
  start_ = state.x;
  for (std::size_t i = 0; i < start_.size(); ++i) {
    state.x[i] += step_s_ * state.v[i];
    state.v[i] = forces_n[i] + springs_.mass()[i] / step_s_ * state.v[i] + inertia_[i] * start_[i];
  }
  x_.take(state.x);
  constant_.take(state.v);
}

void GutProjective::go_downhill() noexcept {
  kernels::begin_forces(inertia_.size(), constant_.planes(), inertia_.data(), x_.planes(), f_.planes());
  forces_.add_implicit(x_, f_);
  for (std::size_t place = 0; place < way_.size(); ++place)
    f_.get(static_cast<std::size_t>(mass_[place]), way_[place].v);
  band_.solve(way_.data());
  for (std::size_t place = 0; place < way_.size(); ++place)
    x_.add(static_cast<std::size_t>(mass_[place]), way_[place].v);
}

// The few iterations leave slow modes short of where the step would take them: what they then have too much,
// and no load gave, is taken from all velocities alike.
void GutProjective::keep_energy(std::span<const Vec3> forces_n, GutState& state) noexcept {
  double allowed_j = energy_j_ - forces_.measure(x_);
  for (std::size_t i = 0; i < start_.size(); ++i) allowed_j += forces_n[i].dot(state.x[i] - start_[i]);
  const double kinetic_j = kinetic_energy(springs_, state.v);
  if (kinetic_j <= allowed_j) return;
  const double share = std::sqrt(std::max(0.0, allowed_j / kinetic_j));
  for (Vec3& v : state.v) v *= share;
}

}  // namespace omentum::physics
