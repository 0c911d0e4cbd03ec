// Law and integrator of an organ with masses, as one thing that is stepped, cut and felt.
#pragma once

#include "physics/dynamics/implicit_step.h"

#include <memory>
#include <optional>
#include <span>

namespace omentum::deform {

/// How a body is moved on.
struct StepperParts {
  std::unique_ptr<physics::ForceLaw> law;  // none: linear elasticity, by the kept factor itself
  double step_s = 0;                       // of the integrator, fixed
  int most_compliance_nodes = 0;           // of one local model
};

/// Backward Euler on a kept factor. The factor's own stiffness is also what a hand feels within a step, be it
/// that of the law or only near it. One thread at a time; what is noexcept allocates nothing.
class BodyStepper {
 public:
  /// `mesh` outlives it. Throws as physics::ImplicitStep does.
  BodyStepper(const geometry::TetraMesh& mesh, const physics::MaterialMap& material,
              const physics::Inertia& inertia, StepperParts parts);

  double step_s() const { return implicit_.step_s(); }
  /// One step under external forces, [3N], N. Their work, J; nothing where the result is not finite.
  std::optional<double> step(physics::BodyState& state, std::span<const double> external) noexcept;
  /// J, of what is left.
  double elastic_energy(std::span<const double> u) noexcept;

  /// Precondition of both: exactly those are there, or gone. False: the factor is of no use any more.
  [[nodiscard]] bool remove(std::span<const geometry::TetId> tetrahedra) noexcept;
  void restore(std::span<const geometry::TetId> removed) noexcept;

  /// physics::ImplicitStep::compliance.
  void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept {
    implicit_.compliance(nodes, block);
  }

 private:
  std::unique_ptr<physics::ForceLaw> law_;
  physics::ImplicitStep implicit_;
};

}  // namespace omentum::deform
