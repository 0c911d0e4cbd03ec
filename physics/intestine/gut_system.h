// An intestine with its mesentery as a whole: what a step of it is.
#pragma once

#include "physics/intestine/gut_collisions.h"
#include "physics/intestine/gut_explicit.h"
#include "physics/intestine/gut_projective.h"

#include <optional>

namespace omentum::physics {

enum class GutMethod {
  kExplicit,    // symplectic Euler: small steps, each cheap
  kProjective,  // backward Euler with a constant matrix: any step
};

struct GutStepSettings {
  GutMethod method = GutMethod::kProjective;
  double step_s = 5e-3;
  int iterations = 8;  // of the projective step
  geometry::Vec3 gravity_m_s2{0, 0, -9.81};
};

/// What acts on a gut during a step. Spans of the caller's, read within the step only.
struct GutLoads {
  std::span<const geometry::Vec3> forces_n{};  // [masses] in W, or empty: none
  std::span<const GutObstacle> obstacles{};    // that stand
  std::span<const MovingSphere> spheres{};     // probes, and other organs'
};

/// How the last step went.
struct GutReport {
  GutCollisionReport collisions;
  double kinetic_j = 0;
  double elastic_j = 0;
  /// The energy is no number, or far above what the loads can have given: the state is not to be believed,
  /// and no step goes on from it until a reset.
  bool diverged = false;
};

/// The springs' step, then the collisions' correction of it. One thread's; the same settings and loads give
/// the same run bit for bit.
///
///     GutSystem gut(make_gut(anatomy), material, collisions, {.step_s = 5e-3});
///     gut.step({.obstacles = cavity, .spheres = probes});  // each 5 ms
class GutSystem final : public GutYield {
 public:
  /// Throws std::invalid_argument naming the member and what is expected of it; for an explicit step above
  /// the stable one too, which it then tells. Allocates what steps need.
  GutSystem(const geometry::GutShape& shape, const GutMaterial& material,
            const GutCollisionSettings& collisions, const GutStepSettings& step);
  GutSystem(const GutSystem&) = delete;  // its parts refer to each other
  GutSystem& operator=(const GutSystem&) = delete;

  /// One step of `step_s`. A force or sphere that is no number shows in report().diverged. Allocates nothing.
  void step(const GutLoads& loads) noexcept;
  /// Back to the shape at the start, at rest.
  void reset() noexcept;
  /// On from where another system of the same gut is, whose step may have any length. Allocates nothing, like
  /// the next.
  void take_up(const GutSystem& other) noexcept;
  /// From where the last step ended towards `wanted`, as far as collisions let it: a step's correction by who
  /// knows better than the springs. Of the loads the obstacles count alone.
  void move_to(const GutState& wanted, const GutLoads& loads) noexcept;

  const geometry::GutShape& shape() const { return shape_; }
  const GutStepSettings& settings() const { return settings_; }
  const GutSprings& springs() const { return springs_; }
  const GutState& state() const { return state_; }
  const GutReport& report() const { return report_; }
  /// Of the last step: how far each sphere of the loads came, and the impulse on it.
  std::span<const SphereOutcome> outcomes() const { return collisions_.outcomes(); }

  /// Of the last step: where the gut touches itself (GutCollisions).
  std::size_t touches(std::span<Touch> found) const noexcept { return collisions_.touches(state_.x, found); }

  /// How far each of `masses` moves within a step along a force on each of them, alike in all directions: the
  /// entries of A^-1 of GutBand, [masses x masses], m/N; 0 where held. Neither allocates.
  void compliance(std::span<const geometry::MassId> masses, std::span<double> block) const noexcept;
  /// A^-1 `forces_n`: how far all masses move within a step. Both [masses].
  void yield_to(std::span<const geometry::Vec3> forces_n,
                std::span<geometry::Vec3> yield_m) const noexcept override;
  std::span<const double> own_yields() const noexcept override { return own_yields_; }
  /// Of the step in progress, by the projective method (GutYield).
  int iterations() const noexcept override { return projective_->iterations(); }
  void go_downhill(std::span<const geometry::Vec3> pushes_n, std::span<geometry::Vec3> x) noexcept override;
  void end_step(std::span<const geometry::Vec3> pushes_n, std::span<const geometry::Vec3> x,
                std::span<geometry::Vec3> v) noexcept override;

 private:
  void gather_forces(std::span<const geometry::Vec3> forces_n) noexcept;
  void watch(std::span<const geometry::Vec3> v) noexcept;
  void observe() noexcept;

  geometry::GutShape shape_;
  GutStepSettings settings_;
  GutSprings springs_;
  GutBand band_;
  std::optional<GutExplicit> explicit_;  // one of the two
  std::optional<GutProjective> projective_;
  GutCollisions collisions_;
  GutForces energies_;
  std::vector<double> own_yields_;  // [masses]
  GutPlanes x_;                     // [masses] of the state, to measure energies
  double wild_j_ = 0;
  bool is_wild_ = false;  // the springs of this step want what cannot be
  GutState state_;
  std::vector<geometry::Vec3> before_;        // [masses]
  std::vector<geometry::Vec3> carried_;       // [masses], m/s: the step's, before it is corrected
  std::vector<geometry::Vec3> forces_;        // [masses], N: weight and loads
  mutable std::vector<GutBand::Node> yield_;  // [free masses]
  GutReport report_;
};

}  // namespace omentum::physics
