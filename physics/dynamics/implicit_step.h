// Backward Euler on a kept factor: steps as large as one likes, at the price of one solve.
#pragma once

#include "physics/dynamics/carried_mass.h"
#include "physics/dynamics/force_law.h"
#include "physics/dynamics/joinable_step.h"
#include "physics/dynamics/kept_factor.h"

namespace omentum::physics {

struct ImplicitOptions {
  double step_s = 0;               // dt, above zero
  int most_compliance_nodes = 24;  // of one call of compliance()
  AddedStiffness added{};          // a part of K beside the mesh's
  bool sheds_mass = true;          // what is removed takes its mass along
};

/// M (v' - v) = dt (f_ext + f(u') - D v'), u' = u + dt v', D = a M + b K, linearized about the rest shape:
/// with dv = v' - v
///
///     ((1 + dt a) M + (dt^2 + dt b) K) dv = dt (f_ext + f(u + (dt + b) v) - a M v).
///
/// Exact for the linear model f = -K u, and then stable for any dt: the energy grows by no more than the work
/// done. What float leaves of a step's equation is known in double and is given to the next step as an
/// impulse, so that momentum is kept and rest is exact, at the cost of a product instead of a second solve.
///
/// All memory is taken at construction; one thread at a time.
class ImplicitStep final : public JoinableStep {
 public:
  /// Throws as KeptFactor does. `mesh` outlives it.
  ImplicitStep(const geometry::TetraMesh& mesh, const MaterialMap& material, const Inertia& inertia,
               const ImplicitOptions& options);

  double step_s() const override { return step_s_; }
  [[nodiscard]] bool step(BodyState& state, std::span<const double> external) noexcept override;
  /// The same with the forces of another law than the factor's own. Stable as long as no stiffness of the law
  /// is above 4/3 of K's in any direction: not for a co-rotational law once the body has turned.
  [[nodiscard]] bool step(BodyState& state, ForceLaw& law, std::span<const double> external) noexcept;
  /// u^T K u / 2.
  double elastic_energy(std::span<const double> u) noexcept override;

  /// A law of its own is told by the caller.
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept override;
  void restore() noexcept override;
  std::span<const double> mass() const noexcept override { return carried_.kg(); }

  /// dt^2 A^-1.
  void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept override;
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override;
  void foresee(const BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept override;
  /// The same with the forces of another law.
  void foresee(const BodyState& state, ForceLaw& law, std::span<const double> external,
               std::span<double> u) noexcept;

  void project_at_rest(std::span<const geometry::NodeId> nodes, std::span<const float> rows,
                       std::span<float> block) noexcept override;
  /// The linear law does not turn.
  void turn(std::span<const geometry::NodeId> /*nodes*/, std::span<float> /*block*/) const noexcept override {
  }

  bool part(const PartedTetrahedra& parted, double anchor_kg) noexcept override;
  bool give_masses(std::span<const geometry::TetId> tetrahedra, std::span<const geometry::NodeId> nodes,
                   std::span<const double> kg) noexcept override;
  KeptFactor& factor() noexcept override { return factor_; }

 private:
  void look_ahead(const BodyState& state) noexcept;
  void find_own_forces() noexcept;
  void find_impulse(const BodyState& state, std::span<const double> external) noexcept;
  void end_of(const BodyState& state, std::span<const double> external, std::span<double> u) noexcept;
  bool finish(BodyState& state, std::span<const double> external) noexcept;

  Inertia inertia_;
  CarriedMass carried_;
  bool sheds_mass_;
  double step_s_;
  KeptFactor factor_;
  std::vector<double> ahead_, forces_, impulse_, change_;  // [3N]
  std::vector<double> lacking_;                            // [3N] what the last step's equation lacks, N s
};

}  // namespace omentum::physics
