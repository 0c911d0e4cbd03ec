// A law of a mesh's own, with a stiffness of another part that is tied to some of its nodes.
#pragma once

#include "physics/dynamics/added_forces.h"
#include "physics/dynamics/force_law.h"

namespace omentum::organ_tools {

/// Of a hybrid organ's dynamic part with what the precomputed one is to it: energies and forces add up. `law`
/// outlives it.
class JoinedLaw final : public physics::ForceLaw {
 public:
  JoinedLaw(physics::ForceLaw& law, const physics::AddedStiffness& added) : law_(law), added_(added) {}

  void forces(std::span<const double> u, std::span<double> f) noexcept override {
    law_.forces(u, f);
    added_.add_product(-1, u, f);
  }
  double energy(std::span<const double> u) const noexcept override {
    return law_.energy(u) + added_.energy(u);
  }
  void remove(geometry::TetId t) noexcept override { law_.remove(t); }
  void add(geometry::TetId t) noexcept override { law_.add(t); }

 private:
  physics::ForceLaw& law_;
  mutable physics::AddedForces added_;  // has a workspace
};

}  // namespace omentum::organ_tools
