#include "physics/intestine/gut_projective.h"

namespace omentum::physics {

using geometry::Vec3;

GutProjective::GutProjective(const GutSprings& springs, const GutBand& band, double step_s, int iterations)
    : springs_(springs),
      band_(band),
      step_s_(step_s),
      iterations_(iterations),
      start_(springs.mass().size()),
      v_(start_.size()),
      f_(start_.size()),
      solved_(band.size()) {}

void GutProjective::step(std::span<const Vec3> forces_n, GutState& state) noexcept {
  start_ = state.x;
  for (std::size_t i = 0; i < start_.size(); ++i) state.x[i] += step_s_ * state.v[i];
  for (int k = 0; k < iterations_; ++k) downhill(forces_n, state.v, state.x);
  for (std::size_t i = 0; i < start_.size(); ++i) state.v[i] = (state.x[i] - start_[i]) / step_s_;
}

void GutProjective::downhill(std::span<const Vec3> forces_n, const std::vector<Vec3>& v,
                             std::vector<Vec3>& x) noexcept {
  for (std::size_t i = 0; i < x.size(); ++i) v_[i] = (x[i] - start_[i]) / step_s_;
  springs_.forces(x, v_, f_);
  const double drag = 1 + step_s_ * springs_.drag_per_s();
  for (std::size_t place = 0; place < solved_.size(); ++place) {
    const auto i = static_cast<std::size_t>(band_.mass(place));
    const Vec3 left = f_[i] + forces_n[i] + springs_.mass()[i] / step_s_ * (v[i] - drag * v_[i]);
    solved_[place] = {{left.x(), left.y(), left.z(), 0}};
  }
  band_.solve(solved_.data());
  for (std::size_t place = 0; place < solved_.size(); ++place) {
    x[static_cast<std::size_t>(band_.mass(place))] += Eigen::Map<const Vec3>(solved_[place].v);
  }
}

}  // namespace omentum::physics
