// Large steps of a body that another part is tied to, as a stiffness of some of its nodes.
#pragma once

#include "physics/dynamics/kept_factor.h"
#include "physics/dynamics/large_step.h"
#include "physics/parting.h"

namespace omentum::physics {

/// What a hybrid organ's dynamic part moves by (physics/hybrid/hybrid_step.h), or all of it, some of whose
/// nodes then have no mass (physics/hybrid/hybrid_cut_step.h).
class JoinableStep : public LargeStep {
 public:
  /// dt^2 E^T A^-1 E, [w x w], m/N where E is without a unit, of columns E that are zero but at `nodes`:
  /// `rows` [3 nodes][w] of them. Of what is left, and of the rest shape: it changes with a removal alone.
  /// Precondition: w is at most three times what one compliance() is of.
  virtual void project_at_rest(std::span<const geometry::NodeId> nodes, std::span<const float> rows,
                               std::span<float> block) noexcept = 0;
  /// Makes a block of displacements per force, [3n x 3n], of `nodes` at rest one where the last step was, in
  /// place. Nodes that are not of the body (invalid), that are held or tied to another part do not turn.
  virtual void turn(std::span<const geometry::NodeId> nodes, std::span<float> block) const noexcept = 0;

  /// remove() of a body with nodes that have no mass, where some have to be anchored, kg each.
  [[nodiscard]] virtual bool part(const PartedTetrahedra& parted, double anchor_kg) noexcept = 0;
  /// What did not turn does from now on, and nodes carry more, kg[i] at nodes[i], which differ. False as
  /// remove().
  [[nodiscard]] virtual bool give_masses(std::span<const geometry::TetId> tetrahedra,
                                         std::span<const geometry::NodeId> nodes,
                                         std::span<const double> kg) noexcept = 0;
  virtual KeptFactor& factor() noexcept = 0;
};

}  // namespace omentum::physics
