// Backward Euler on a kept factor: steps as large as one likes, at the price of one solve.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/dynamics/force_law.h"
#include "physics/dynamics/kept_factor.h"

namespace omentum::physics {

struct ImplicitOptions {
  double step_s = 0;               // dt, above zero
  int most_compliance_nodes = 24;  // of one call of compliance()
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
class ImplicitStep {
 public:
  /// Throws as KeptFactor does. `mesh` outlives it.
  ImplicitStep(const geometry::TetraMesh& mesh, const MaterialMap& material, const Inertia& inertia,
               const ImplicitOptions& options);

  /// One step under `external` forces, [3N], N. False: the result is not finite.
  [[nodiscard]] bool step(BodyState& state, std::span<const double> external) noexcept;
  /// The same with the forces of another law than the factor's own. Stable as long as no stiffness of the law
  /// is above 4/3 of K's in any direction: not for a co-rotational law once the body has turned.
  [[nodiscard]] bool step(BodyState& state, ForceLaw& law, std::span<const double> external) noexcept;

  /// Tetrahedra go and all come back: KeptFactor::remove and restore. A law of its own is told by the caller.
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept;
  void restore() noexcept;

  /// Displacement of `nodes` at the end of a step per force held over it, [3n x 3n], m/N, symmetric: dt^2
  /// A^-1.
  void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept;

  /// u^T K u / 2 with what is left, J.
  double elastic_energy(std::span<const double> u) noexcept;
  double step_s() const { return step_s_; }
  KeptFactor& factor() { return factor_; }

 private:
  bool finish(BodyState& state, std::span<const double> external) noexcept;

  Inertia inertia_;
  double step_s_;
  KeptFactor factor_;
  std::vector<double> ahead_, forces_, impulse_, change_;  // [3N]
  std::vector<double> lacking_;                            // [3N] what the last step's equation lacks, N s
};

}  // namespace omentum::physics
