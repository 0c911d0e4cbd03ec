// Law and integrator of an organ with masses, as one thing that is stepped, cut and felt.
#pragma once

#include "deform_node/body_loads.h"
#include "physics/dynamics/explicit_step.h"
#include "physics/dynamics/force_law.h"
#include "physics/dynamics/large_step.h"

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
  /// Before the steps of a tick under new loads.
  virtual void prepare() noexcept {}
  /// One step under `loads`, which are told how strong presses became. Their work, J; nothing where the
  /// result is not finite.
  virtual std::optional<double> step(physics::BodyState& state, BodyLoads& loads) noexcept = 0;
  /// The same in kShorter steps, or in one that is more exact, under the forces that step() found; nothing
  /// also where there is neither.
  virtual std::optional<double> step_shorter(physics::BodyState& /*state*/, BodyLoads& /*loads*/) noexcept {
    return {};
  }
  /// Whether that was in shorter steps: whoever watches is told.
  virtual bool shortens() const noexcept { return true; }
  /// J, of what is left.
  virtual double elastic_energy(std::span<const double> u) noexcept = 0;

  /// Precondition of both: exactly those are there, or gone. False: the factor is of no use any more.
  [[nodiscard]] virtual bool remove(std::span<const geometry::TetId> tetrahedra) noexcept = 0;
  virtual void restore(std::span<const geometry::TetId> removed) noexcept = 0;
  /// What the next remove() leaves without supports, of a body whose pieces fall (LoosePieces::kFall): it has
  /// masses from now on.
  virtual void let_go(std::span<const geometry::TetId> /*tetrahedra*/) noexcept {}

  /// What each node carries now, [N], kg: of what is left (physics::CarriedMass), or of the uncut body where
  /// steps are explicit; zero where it moves without. Whoever needs masses has them from here.
  virtual std::span<const double> mass() const noexcept = 0;
  /// False: no hand feels it, and compliance() is not asked for.
  virtual bool is_felt() const { return true; }
  /// What a hand feels within so long, s: displacement of `nodes` per force held, [3n x 3n], m/N, symmetric;
  /// and where the body will be if all forces stay as they are, [3N].
  virtual double felt_s() const { return step_s(); }
  virtual void compliance(std::span<const geometry::NodeId> nodes, std::span<float> block) noexcept = 0;
  virtual void foresee(const physics::BodyState& state, std::span<const double> external,
                       std::span<double> u) noexcept = 0;
  /// Displacement of all nodes after that time per forces held over it, [3N], m.
  virtual void yield_to(std::span<const double> forces, std::span<double> yield) noexcept = 0;
};

/// Backward Euler for linear elasticity; presses are imposed (physics/dynamics/imposed_press.h). Throws as
/// physics::ImplicitStep does, like the others.
std::unique_ptr<BodyStepper> make_implicit_stepper(const SteppedBody& body, double step_s);

/// Any other large step of a body of so many nodes.
std::unique_ptr<BodyStepper> make_large_stepper(std::size_t node_count,
                                                std::unique_ptr<physics::LargeStep> step);

/// Backward Euler for co-rotational tissue (physics/dynamics/warped_step.h).
std::unique_ptr<BodyStepper> make_warped_stepper(const SteppedBody& body, double step_s);

/// What becomes of that which a cut leaves without supports.
enum class LoosePieces {
  kDrop,  // a removal takes it along: nothing is left that floats
  kFall,  // it moves on by the co-rotational law, once let_go() says so (deform_node/falling_pieces.h)
};

/// No masses: equilibrium in every step, under presses that are imposed (physics/static_factor.h).
std::unique_ptr<BodyStepper> make_static_stepper(const SteppedBody& body, double step_s,
                                                 LoosePieces loose = LoosePieces::kDrop);

/// Explicit steps. Presses are made as strong as would bring the body where hands want it within kFeltStep_s.
/// Nothing yields within one of them, and none has an equation whose solution would say how: what a hand
/// feels of the body is the compliance at rest over kFeltStep_s, the time between two local models, s.
inline constexpr double kFeltStep_s = 0.005;
/// That is the compliance of linear elasticity: a body of another law at rest, such as springs, is not felt.
std::unique_ptr<BodyStepper> make_explicit_stepper(const SteppedBody& body,
                                                   std::unique_ptr<physics::ForceLaw> law,
                                                   physics::ExplicitScheme scheme, double step_s,
                                                   bool is_linear_at_rest = true);

}  // namespace omentum::deform
