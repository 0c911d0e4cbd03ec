#include "physics/dynamics/explicit_step.h"

#include "geometry/precondition.h"

#include <Eigen/Core>

namespace omentum::physics {

namespace {

using Values = std::vector<double>;

// Classical weights of the four slopes, and how far along each the next one is taken.
constexpr std::array<double, 4> kWeights{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
constexpr std::array<double, 3> kReach{0.5, 0.5, 1.0};

Values inverse_masses(const Inertia& inertia) {
  geometry::require(inertia.fixed.size() == inertia.mass.size(), "supports of each node");
  Values inverse(3 * inertia.mass.size());
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    const bool held = is_fixed(inertia.fixed[i / 3], static_cast<int>(i % 3));
    inverse[i] = held ? 0 : 1 / inertia.mass[i / 3];
  }
  return inverse;
}

Eigen::Map<Eigen::ArrayXd> all(Values& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

Eigen::Map<const Eigen::ArrayXd> all(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

double dot(std::span<const double> a, const Values& b) {
  return all(a).matrix().dot(all(b).matrix());
}

}  // namespace

const char* name_of(ExplicitScheme scheme) {
  constexpr std::array kNames{"forward-euler", "symplectic-euler", "rk4"};
  return kNames[static_cast<std::size_t>(scheme)];
}

ExplicitStep::ExplicitStep(ExplicitScheme scheme, const Inertia& inertia)
    : scheme_(scheme), inertia_(inertia), inverse_mass_(inverse_masses(inertia)) {
  const std::size_t size = inverse_mass_.size();
  ahead_.resize(size);
  a_.resize(size);
  if (scheme == ExplicitScheme::kRungeKutta4) {
    for (Values* stage : {&u_stage_, &v_stage_, &u_slope_, &v_slope_}) stage->resize(size);
  }
}

double ExplicitStep::step(ForceLaw& law, std::span<const double> external_n, double dt_s,
                          BodyState& state) noexcept {
  const std::size_t size = inverse_mass_.size();
  geometry::require(external_n.size() == size && state.u.size() == size && state.v.size() == size,
                    "three values for each node");
  switch (scheme_) {
    case ExplicitScheme::kForwardEuler:
      return forward_euler(law, external_n, dt_s, state);
    case ExplicitScheme::kSymplecticEuler:
      return symplectic_euler(law, external_n, dt_s, state);
    case ExplicitScheme::kRungeKutta4:
      break;
  }
  return runge_kutta(law, external_n, dt_s, state);
}

void ExplicitStep::accelerate(ForceLaw& law, std::span<const double> external_n, const Values& u,
                              const Values& v, double drag_per_s) noexcept {
  const double b = inertia_.stiffness_damping_s;
  if (b > 0) all(ahead_) = all(u) + b * all(v);
  law.forces(b > 0 ? ahead_ : u, a_);
  all(a_) = (all(a_) + all(external_n)) * all(inverse_mass_) - drag_per_s * all(v);
}

double ExplicitStep::forward_euler(ForceLaw& law, std::span<const double> external_n, double dt,
                                   BodyState& state) noexcept {
  accelerate(law, external_n, state.u, state.v, inertia_.mass_damping_per_s);
  const double work = dt * dot(external_n, state.v);
  all(state.u) += dt * all(state.v);
  all(state.v) += dt * all(a_);
  return work;
}

double ExplicitStep::symplectic_euler(ForceLaw& law, std::span<const double> external_n, double dt,
                                      BodyState& state) noexcept {
  accelerate(law, external_n, state.u, state.v, 0);
  const double slowed = 1 / (1 + dt * inertia_.mass_damping_per_s);
  all(state.v) = slowed * all(state.v) + slowed * dt * all(a_);
  all(state.u) += dt * all(state.v);
  return dt * dot(external_n, state.v);
}

double ExplicitStep::runge_kutta(ForceLaw& law, std::span<const double> external_n, double dt,
                                 BodyState& state) noexcept {
  all(u_stage_) = all(state.u);
  all(v_stage_) = all(state.v);
  all(u_slope_) = 0;
  all(v_slope_) = 0;
  for (std::size_t stage = 0; stage < kWeights.size(); ++stage) {
    accelerate(law, external_n, u_stage_, v_stage_, inertia_.mass_damping_per_s);
    all(u_slope_) += kWeights[stage] * all(v_stage_);
    all(v_slope_) += kWeights[stage] * all(a_);
    if (stage == kReach.size()) break;
    all(u_stage_) = all(state.u) + kReach[stage] * dt * all(v_stage_);
    all(v_stage_) = all(state.v) + kReach[stage] * dt * all(a_);
  }
  all(state.u) += dt * all(u_slope_);
  all(state.v) += dt * all(v_slope_);
  return dt * dot(external_n, u_slope_);
}

}  // namespace omentum::physics
