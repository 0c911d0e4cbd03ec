#include "physics/dynamics/implicit_step.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {

ImplicitStep::ImplicitStep(const geometry::TetraMesh& mesh, const MaterialMap& material,
                           const Inertia& inertia, const ImplicitOptions& options)
    : inertia_(inertia),
      carried_(mesh, material, inertia.mass),
      sheds_mass_(options.sheds_mass),
      step_s_(options.step_s),
      factor_(mesh, material, inertia.fixed, inertia.mass, weights_of(inertia, options.step_s),
              options.most_compliance_nodes, options.added),
      ahead_(3 * inertia.mass.size()),
      forces_(ahead_.size()),
      impulse_(ahead_.size()),
      change_(ahead_.size()),
      lacking_(ahead_.size()) {}

bool ImplicitStep::step(BodyState& state, std::span<const double> external) noexcept {
  look_ahead(state);
  find_own_forces();
  return finish(state, external);
}

bool ImplicitStep::step(BodyState& state, ForceLaw& law, std::span<const double> external) noexcept {
  look_ahead(state);
  law.forces(ahead_, forces_);
  return finish(state, external);
}

void ImplicitStep::foresee(const BodyState& state, std::span<const double> external,
                           std::span<double> u) noexcept {
  look_ahead(state);
  find_own_forces();
  end_of(state, external, u);
}

void ImplicitStep::foresee(const BodyState& state, ForceLaw& law, std::span<const double> external,
                           std::span<double> u) noexcept {
  look_ahead(state);
  law.forces(ahead_, forces_);
  end_of(state, external, u);
}

void ImplicitStep::end_of(const BodyState& state, std::span<const double> external,
                          std::span<double> u) noexcept {
  find_impulse(state, external);
  factor_.solve_roughly(impulse_, change_);
  for (std::size_t c = 0; c < u.size(); ++c) u[c] = state.u[c] + step_s_ * (state.v[c] + change_[c]);
}

void ImplicitStep::look_ahead(const BodyState& state) noexcept {
  const double reach = step_s_ + inertia_.stiffness_damping_s;
  for (std::size_t c = 0; c < ahead_.size(); ++c) ahead_[c] = state.u[c] + reach * state.v[c];
}

void ImplicitStep::find_own_forces() noexcept {
  factor_.holding_forces(ahead_, forces_);
  for (double& f : forces_) f = -f;
}

void ImplicitStep::find_impulse(const BodyState& state, std::span<const double> external) noexcept {
  for (std::size_t c = 0; c < impulse_.size(); ++c) {
    const double drag = inertia_.mass_damping_per_s * carried_.kg()[c / 3] * state.v[c];
    impulse_[c] = lacking_[c] + step_s_ * (external[c] + forces_[c] - drag);
  }
}

bool ImplicitStep::finish(BodyState& state, std::span<const double> external) noexcept {
  find_impulse(state, external);
  factor_.solve_roughly(impulse_, change_);
  factor_.multiply(change_, lacking_);
  double speed = 0;
  for (std::size_t c = 0; c < change_.size(); ++c) {
    const bool held = is_fixed(inertia_.fixed[c / 3], static_cast<int>(c % 3));
    lacking_[c] = held ? 0.0 : impulse_[c] - lacking_[c];
    state.v[c] += change_[c];
    state.u[c] += step_s_ * state.v[c];
    speed += state.v[c] * state.v[c];
  }
  if (std::isfinite(speed)) return true;
  std::ranges::fill(lacking_, 0.0);  // whoever goes on from a state that is known owes nothing to this step
  return false;
}

bool ImplicitStep::remove(std::span<const geometry::TetId> tetrahedra) noexcept {
  const bool definite = factor_.remove(tetrahedra);
  if (!sheds_mass_) return definite;
  carried_.remove(tetrahedra);
  return factor_.take_mass(carried_.lightened(), carried_.lost_kg()) && definite;
}

// What goes as a whole moves on by itself, of which nobody hears.
bool ImplicitStep::part(const PartedTetrahedra& parted, double anchor_kg) noexcept {
  const bool is_anchored = factor_.add_mass(parted.loose, anchor_kg);
  return remove(parted.taken) && is_anchored;
}

bool ImplicitStep::give_masses(std::span<const geometry::TetId> /*tetrahedra*/,
                               std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept {
  carried_.give(nodes, kg);
  return factor_.add_masses(nodes, kg);
}

void ImplicitStep::restore() noexcept {
  factor_.restore();
  carried_.restore();
  std::ranges::fill(lacking_, 0.0);
}

void ImplicitStep::compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept {
  factor_.inverse_block(nodes, block);
  const auto scale = static_cast<float>(step_s_ * step_s_);
  for (std::size_t i = 0; i < 9 * nodes.size() * nodes.size(); ++i) block[i] *= scale;
}

void ImplicitStep::project_at_rest(std::span<const geometry::NodeId> nodes, std::span<const float> rows,
                                   std::span<float> block) noexcept {
  factor_.project_inverse(nodes, rows, block);
  for (float& c : block) c *= static_cast<float>(step_s_ * step_s_);
}

void ImplicitStep::yield_to(std::span<const double> forces, std::span<double> yield) noexcept {
  factor_.solve(forces, yield);
  for (double& y : yield) y *= step_s_ * step_s_;
}

double ImplicitStep::elastic_energy(std::span<const double> u) noexcept {
  factor_.holding_forces(u, forces_);
  double twice = 0;
  for (std::size_t c = 0; c < forces_.size(); ++c) twice += u[c] * forces_[c];
  return twice / 2;
}

}  // namespace omentum::physics
