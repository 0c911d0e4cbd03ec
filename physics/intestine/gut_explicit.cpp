#include "physics/intestine/gut_explicit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace omentum::physics {

using geometry::Vec3;

namespace {

// Of M^-1/2 K M^-1/2 with K the springs without regard to their directions, which is never below the true
// stiffness of springs that are not compressed: largest eigenvalue by its row sums (Gershgorin), 1/s^2.
class RowSums {
 public:
  explicit RowSums(const GutSprings& springs) : inverse_(springs.inverse_mass()), sums_(inverse_.size()) {}

  void couple(std::size_t a, std::size_t b, double k) {
    sums_[a] += std::abs(k) * std::sqrt(inverse_[a] * inverse_[b]);
  }
  void couple_both(std::size_t a, std::size_t b, double k) {
    couple(a, b, k);
    couple(b, a, k);
  }
  double largest() const { return *std::max_element(sums_.begin(), sums_.end()); }

 private:
  std::span<const double> inverse_;
  std::vector<double> sums_;
};

double squared_frequency_bound(const GutSprings& springs) {
  RowSums rows(springs);
  for (const auto& [offset, stiffness, rest] : springs.families()) {
    for (std::size_t a = 0; a < stiffness.size(); ++a) {
      if (stiffness[a] == 0) continue;
      const std::size_t b = a + static_cast<std::size_t>(offset);
      rows.couple(a, a, stiffness[a]);
      rows.couple(b, b, stiffness[a]);
      rows.couple_both(a, b, stiffness[a]);
    }
  }
  const std::vector<double>& bends = springs.bends().stiffness_n_m;
  for (std::size_t c = 1; c + 1 < bends.size(); ++c) {
    rows.couple(c, c, bends[c]);
    rows.couple(c - 1, c - 1, bends[c] / 4);
    rows.couple(c + 1, c + 1, bends[c] / 4);
    rows.couple_both(c - 1, c, bends[c] / 2);
    rows.couple_both(c, c + 1, bends[c] / 2);
    rows.couple_both(c - 1, c + 1, bends[c] / 4);
  }
  return rows.largest();
}

}  // namespace

double stable_step_s(const GutSprings& springs) {
  const double w2 = squared_frequency_bound(springs), damped = springs.damping_s() * w2;
  return 4 / (damped + std::sqrt(damped * damped + 4 * w2));
}

GutExplicit::GutExplicit(const GutSprings& springs, double step_s)
    : springs_(springs),
      step_s_(step_s),
      forces_(springs),
      x_(springs.mass().size()),
      v_(springs.mass().size()),
      f_(springs.mass().size()) {
  const double stable_s = stable_step_s(springs);
  if (step_s <= stable_s) return;
  throw std::invalid_argument("step_s: found " + std::to_string(step_s) + ", expected at most " +
                              std::to_string(stable_s) + " for the explicit step of this gut");
}

void GutExplicit::step(std::span<const Vec3> forces_n, GutState& state) noexcept {
  x_.take(state.x);
  v_.take(state.v);
  f_.take(forces_n);
  forces_.add_explicit(x_, v_, f_);
  const double kept = 1 / (1 + step_s_ * springs_.drag_per_s());
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const double inverse_mass = springs_.inverse_mass()[i];
    if (inverse_mass == 0) continue;
    state.v[i] = kept * (state.v[i] + step_s_ * inverse_mass * f_.at(i));
    state.x[i] += step_s_ * state.v[i];
  }
}

}  // namespace omentum::physics
