// Law and integrator of an organ with masses, as one thing that is stepped, cut and felt.
#pragma once

#include "physics/dynamics/explicit_step.h"
#include "physics/dynamics/implicit_step.h"

#include <memory>
#include <optional>
#include <span>

namespace omentum::deform {

/// How a body is moved on.
struct StepperParts {
  std::unique_ptr<physics::ForceLaw> law;         // none: linear elasticity, by the kept factor itself
  std::optional<physics::ExplicitScheme> scheme;  // needs a law; none: backward Euler on the kept factor
  double step_s = 0;                              // of the integrator, fixed
  double energy_margin = 2;                       // of a sound integration (physics/dynamics/energy_watch.h)
  int most_compliance_nodes = 0;                  // of one local model
};

/// Every body keeps the factor of an implicit step. One that is moved on by an explicit scheme has it for the
/// hand alone: explicit steps are too short for anything to yield within one, and have no equation whose
/// solution would say how it does. The factor's stiffness is that of the body at rest, be it the law's or
/// only near it. One thread at a time; what is noexcept allocates nothing.
class BodyStepper {
 public:
  /// What a hand feels of a body that is moved on explicitly is how it yields within this, s: the time
  /// between two local models.
  static constexpr double kFeltStep_s = 0.005;
  /// Into so many steps one is divided that would diverge.
  static constexpr int kShorter = 4;

  /// `mesh` outlives it. Throws as physics::ImplicitStep does.
  BodyStepper(const geometry::TetraMesh& mesh, const physics::MaterialMap& material,
              const physics::Inertia& inertia, StepperParts parts);

  double step_s() const { return step_s_; }
  /// The implicit step's length is in its factor.
  bool can_shorten() const { return explicit_.has_value(); }

  /// One step under external forces, [3N], N. Their work, J; nothing where the result is not finite.
  std::optional<double> step(physics::BodyState& state, std::span<const double> external) noexcept;
  /// The same in kShorter steps. Precondition: can_shorten().
  std::optional<double> step_shorter(physics::BodyState& state, std::span<const double> external) noexcept;
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
  physics::Inertia inertia_;
  std::unique_ptr<physics::ForceLaw> law_;
  std::optional<physics::ExplicitStep> explicit_;
  double step_s_;
  physics::ImplicitStep implicit_;
};

}  // namespace omentum::deform
