// A box of tissue that swings from one of its sides.
#pragma once

#include "physics/dynamics/stable_step.h"
#include "physics/dynamics/tensor_mass.h"
#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/support/meshes.h"

namespace omentum::test {

struct SwingingBody {
  using Arithmetic = physics::TensorMass::Arithmetic;

  explicit SwingingBody(Arithmetic arithmetic = Arithmetic::kFloat) : law(mesh, material, arithmetic) {}

  double energy(const physics::BodyState& state) const {
    return physics::kinetic_energy(inertia, state.v) + law.energy(state.u);
  }

  /// Displaced and moving in all modes, held where it is held.
  physics::BodyState pushed() const {
    physics::BodyState state{random_values(3 * mesh.positions.size(), 1e-4, 1),
                             random_values(3 * mesh.positions.size(), 1e-2, 2)};
    for (std::size_t i = 0; i < state.u.size(); ++i)
      if (inertia.fixed[i / 3] != 0) state.u[i] = state.v[i] = 0;
    return state;
  }

  geometry::TetraMesh mesh = make_box_mesh(3, 3, 4, {0.03, 0.03, 0.05});
  physics::Material material{5000, 0.45, 1000};
  physics::Inertia inertia = [&] {
    physics::Inertia made{physics::lumped_masses(mesh, material), {}};
    for (const geometry::Vec3& p : mesh.positions) made.fixed.push_back(p.z() == 0 ? physics::kPinned : 0);
    return made;
  }();
  physics::TensorMass law;
};

/// Independent oscillators: node n has stiffness[n] along all axes.
class Springs final : public physics::ForceLaw {
 public:
  explicit Springs(std::vector<double> stiffness) : stiffness_(std::move(stiffness)) {}
  void forces(std::span<const double> u, std::span<double> f) noexcept override {
    for (std::size_t i = 0; i < u.size(); ++i) f[i] = -stiffness_[i / 3] * u[i];
  }
  double energy(std::span<const double> u) const noexcept override {
    double twice = 0;
    for (std::size_t i = 0; i < u.size(); ++i) twice += stiffness_[i / 3] * u[i] * u[i];
    return twice / 2;
  }
  void remove(geometry::TetId t) noexcept override { stiffness_[t] = 0; }
  void add(geometry::TetId) noexcept override {}

 private:
  std::vector<double> stiffness_;
};

}  // namespace omentum::test
