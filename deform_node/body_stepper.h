// Law and integrator of an organ with masses, as one thing that is stepped, cut and felt.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/dynamics/explicit_step.h"
#include "physics/dynamics/force_law.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>

namespace omentum::deform {

/// What a stepper moves. `mesh` outlives it.
struct SteppedBody {
  const geometry::TetraMesh& mesh;
  const physics::MaterialMap& material;
  physics::Inertia inertia;
};

/// Moves a body on by steps of fixed length. Every one keeps the factor of an implicit step, at least for the
/// hand. One thread at a time; what is noexcept allocates nothing.
class BodyStepper {
 public:
  /// Nodes that one compliance is of at most: as many as a LAN carries (transport::local_model_nodes).
  static constexpr int kPatchNodes = 24;
  /// Into so many steps one is divided that would diverge.
  static constexpr int kShorter = 4;

  virtual ~BodyStepper() = default;

  virtual double step_s() const = 0;
  /// One step under external forces, [3N], N. Their work, J; nothing where the result is not finite.
  virtual std::optional<double> step(physics::BodyState& state,
                                     std::span<const double> external) noexcept = 0;
  /// The same in kShorter steps; nothing also where the step's length is in the factor.
  virtual std::optional<double> step_shorter(physics::BodyState& /*state*/,
                                             std::span<const double> /*external*/) noexcept {
    return {};
  }
  /// J, of what is left.
  virtual double elastic_energy(std::span<const double> u) noexcept = 0;

  /// How all nodes move on while the external forces stay: their way in the next step over its time, [3N],
  /// m/s. What a body of another kind answers is its velocity now.
  virtual void held_motion(const physics::BodyState& state, std::span<const double> /*external*/,
                           std::span<double> motion) noexcept {
    std::copy(state.v.begin(), state.v.end(), motion.begin());
  }

  /// Precondition of both: exactly those are there, or gone. False: the factor is of no use any more.
  [[nodiscard]] virtual bool remove(std::span<const geometry::TetId> tetrahedra) noexcept = 0;
  virtual void restore(std::span<const geometry::TetId> removed) noexcept = 0;

  /// Displacement of `nodes` at the end of a step per force held over it, [3n x 3n], m/N, symmetric.
  virtual void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept = 0;
};

/// Backward Euler for linear elasticity. Throws as physics::ImplicitStep does, like the others.
std::unique_ptr<BodyStepper> make_implicit_stepper(const SteppedBody& body, double step_s);

/// Backward Euler for co-rotational tissue (physics/dynamics/warped_step.h).
std::unique_ptr<BodyStepper> make_warped_stepper(const SteppedBody& body, double step_s);

/// Explicit steps. Nothing yields within one of them, and none has an equation whose solution would say how:
/// what a hand feels of the body is the compliance at rest over kFeltStep_s, the time between two local
/// models, s.
inline constexpr double kFeltStep_s = 0.01;
std::unique_ptr<BodyStepper> make_explicit_stepper(const SteppedBody& body,
                                                   std::unique_ptr<physics::ForceLaw> law,
                                                   physics::ExplicitScheme scheme, double step_s);

}  // namespace omentum::deform
