// Backward Euler for co-rotational tissue: large rotations at large steps, without a factorization.
#pragma once

#include "physics/dynamics/added_forces.h"
#include "physics/dynamics/carried_mass.h"
#include "physics/dynamics/corotational.h"
#include "physics/dynamics/joinable_step.h"
#include "physics/dynamics/kept_factor.h"
#include "physics/dynamics/linear_tissue.h"

namespace omentum::physics {

struct WarpedOptions {
  double step_s = 0;                   // dt, above zero
  double tolerance = 1e-3;             // what the equation of a step may lack, over its right-hand side
  int most_iterations = 40;            // of one step; what is lacking then goes to the next one
  int most_compliance_nodes = 24;      // of one call of compliance()
  AddedStiffness added{};              // a part of K beside the mesh's, linear: it does not turn
  std::vector<std::uint8_t> linear{};  // [T] other than 0: tetrahedra that are likewise; empty: none is
};

/// M (v' - v) = dt (f_ext + f(u') - D v'), u' = u + dt v', D = a M + b K, linearized where the body goes by
/// itself, u + dt v, with the warped stiffness K there: with dv = v' - v
///
///     ((1 + dt a) M + (dt^2 + dt b) K) dv = dt (f_ext + f(u + dt v) - b K v - a M v).
///
/// By conjugate gradients, preconditioned by the factor of the same matrix at rest, turned at each node:
/// Q A_0^-1 Q^T, Q_n the mean rotation of the tetrahedra around node n. For a body that only turned this is
/// the inverse itself; where it bends, the better the slower rotations change from node to node. Each solve
/// begins from the answer to the last equation of its kind, as far as it is one to this. What a step's
/// equation lacks in the end is given to the next one as an impulse, so that momentum is kept. What is added
/// to K is linear, and as exact as in ImplicitStep; its nodes are not turned.
///
/// All memory is taken at construction; one thread at a time.
class WarpedStep final : public JoinableStep {
 public:
  /// Throws as KeptFactor does. `mesh` outlives it; `law` is of the same mesh and material, and has lost
  /// nothing yet.
  WarpedStep(const geometry::TetraMesh& mesh, const MaterialMap& material, const Inertia& inertia,
             Corotational law, const WarpedOptions& options);

  double step_s() const override { return options_.step_s; }
  [[nodiscard]] bool step(BodyState& state, std::span<const double> external) noexcept override;
  /// Linearized again and again, until the step's equation itself holds: energy afterwards is no more than it
  /// was, and the work. Several times as long; what step() left undone is not made up for.
  [[nodiscard]] bool step_again(BodyState& state, std::span<const double> external) noexcept override;
  double elastic_energy(std::span<const double> u) noexcept override {
    return law_.energy(u) + added_.energy(u) + linear_.energy(u);
  }

  /// From the law and from the factor.
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept override;
  void restore() noexcept override;
  std::span<const double> mass() const noexcept override { return carried_.kg(); }

  /// Those of the body at rest, turned at each node as of the last step.
  void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept override;
  void project_at_rest(std::span<const geometry::NodeId> nodes, std::span<const float> rows,
                       std::span<float> block) noexcept override;
  void turn(std::span<const geometry::NodeId> nodes, std::span<float> block) const noexcept override;
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override;
  void foresee(const BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept override;

  bool part(const PartedTetrahedra& parted, double anchor_kg) noexcept override;
  bool give_masses(std::span<const geometry::TetId> tetrahedra, std::span<const geometry::NodeId> nodes,
                   std::span<const double> kg) noexcept override;
  KeptFactor& factor() noexcept override { return factor_; }

  /// Of the last equation that was solved.
  int iterations() const { return iterations_; }
  Corotational& law() { return law_; }

 private:
  struct Potential {
    double least_j, own_j;
  };
  Potential potential(std::span<const double> v_before, std::span<const double> external) noexcept;
  bool go_along(std::span<const double> v_before, std::span<const double> external, double most_j) noexcept;
  void count_ties() noexcept;
  void take_off_law(std::span<const geometry::TetId> tetrahedra) noexcept;
  bool is_held(std::size_t c) const noexcept;
  void linearize(const BodyState& state) noexcept;
  void mean_rotations() noexcept;
  bool turns(std::size_t n) const noexcept { return stands_[n] == 0 && !linear_.ties(geometry::NodeId(n)); }
  void find_forces(std::span<const double> v) noexcept;
  void add_impulse(std::span<const double> external, std::span<double> lacking) noexcept;
  void multiply(std::span<const double> x, std::span<double> y) noexcept;
  void precondition(std::span<const double> residual, std::span<double> x) noexcept;
  double enough_of(std::span<const double> right_hand_side) const noexcept;
  void start_from(std::span<double> x, std::span<double> lacking) noexcept;
  bool solve(double enough, std::span<double> lacking, std::span<double> x) noexcept;

  const geometry::TetraMesh& mesh_;
  Inertia inertia_;
  CarriedMass carried_;
  Corotational law_;
  AddedForces added_;
  LinearTissue linear_;
  WarpedOptions options_;
  KeptFactor factor_;
  std::vector<std::uint8_t> left_;    // [T] 1: there, 0: removed
  std::vector<std::uint8_t> stands_;  // [N] 1: held or tied, so that it is never turned
  std::vector<std::int32_t> ties_;    // [N] tetrahedra that are left, and what is added; 0: stays where it is
  std::vector<Eigen::Matrix3d> rotation_;  // [N] Q
  BodyState again_;                        // workspace of step_again()
  BodyState linear_at_;                    // where the law, the rotations and the forces are of ...
  bool is_linear_ = false;                 // ... if they are
  std::vector<double> ahead_, forces_;     // [3N] u + dt v there; f(u + dt v) - D v, N
  std::vector<double> change_, foreseen_;  // [3N] dv of the last step, of the last foresee(), m/s
  std::vector<double> direction_, product_, turned_, solved_;  // [3N]
  std::vector<double> lacking_;                                // [3N] of an equation that is no step's
  std::vector<double> residual_;  // [3N] what the last step's equation lacks, N s
  double enough_ = 0;             // what the last step's equation was allowed to lack, N s
  int iterations_ = 0;
};

}  // namespace omentum::physics
