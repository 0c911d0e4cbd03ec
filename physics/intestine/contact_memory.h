// What contacts held the masses of an intestine with, for the step to come.
#pragma once

#include "physics/intestine/gut_forces.h"
#include "physics/intestine/gut_obstacle.h"
#include "physics/intestine/gut_state.h"

namespace omentum::physics {

/// Contacts are corrected after the springs' step, mass by mass, while an implicit step moves each mass with
/// its neighbours: what rests would be moved by the one and not quite back by the other, step after step. So
/// the next step of the springs is told a share of the force that the corrections stand for, and leaves them
/// little to do. The force is never larger than what presses on the mass: a mass that was stopped is not
/// thrown back. Near a sphere nothing is remembered, so that all of the contact shows in the impulse on it.
/// One thread's; nothing allocates after construction.
class ContactMemory {
 public:
  /// `springs` outlives it. `reach_m`: how far from the surface of a sphere a mass may be that it moves.
  ContactMemory(const GutSprings& springs, double step_s, double reach_m);

  /// [masses], N.
  std::span<const geometry::Vec3> forces_n() const { return remembered_; }

  /// After a step: `predicted` by the springs under `loads_n`, and where contacts then put the masses:
  /// `state`. [masses] each.
  void learn(std::span<const geometry::Vec3> predicted, std::span<const geometry::Vec3> loads_n,
             const GutState& state, std::span<const MovingSphere> spheres) noexcept;
  void forget() noexcept;

 private:
  geometry::Vec3 blend(std::size_t mass, const geometry::Vec3& correction_n) const noexcept;
  bool is_near(std::span<const MovingSphere> spheres, const geometry::Vec3& x) const noexcept;

  const GutSprings& springs_;
  double per_square_step_;  // 1 / dt^2
  double reach_m_;
  GutForces forces_;
  GutPlanes x_, v_, pressing_;              // [masses]; what is not contact, N
  std::vector<geometry::Vec3> remembered_;  // [masses], N
};

}  // namespace omentum::physics
