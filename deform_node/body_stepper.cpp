#include "deform_node/body_stepper.h"

#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/warped_step.h"

#include <cmath>
#include <utility>

namespace omentum::deform {

namespace {

using geometry::NodeId;
using geometry::TetId;
using physics::BodyState;
using physics::ForceLaw;

using Work = std::optional<double>;

// Of forces that were held over a step of `dt` which ended with `state`.
double work_of(std::span<const double> external, const BodyState& state, double dt) {
  double power_w = 0;
  for (std::size_t c = 0; c < external.size(); ++c) power_w += external[c] * state.v[c];
  return power_w * dt;
}

physics::ImplicitStep implicit_of(const SteppedBody& body, double step_s) {
  return {body.mesh,
          body.material,
          body.inertia,
          {.step_s = step_s, .most_compliance_nodes = BodyStepper::kPatchNodes}};
}

class ImplicitStepper final : public BodyStepper {
 public:
  ImplicitStepper(const SteppedBody& body, double step_s)
      : inertia_(body.inertia),
        implicit_(implicit_of(body, step_s)),
        impulse_(3 * body.inertia.mass.size()) {}

  double step_s() const override { return implicit_.step_s(); }
  Work step(BodyState& state, std::span<const double> external) noexcept override {
    if (!implicit_.step(state, external)) return {};
    return work_of(external, state, step_s());
  }
  // the equation of physics::ImplicitStep, without a trace in it
  void held_motion(const BodyState& state, std::span<const double> external,
                   std::span<double> motion) noexcept override {
    const double dt = step_s(), reach = dt + inertia_.stiffness_damping_s;
    for (std::size_t c = 0; c < impulse_.size(); ++c) motion[c] = state.u[c] + reach * state.v[c];
    implicit_.factor().holding_forces(motion, impulse_);
    for (std::size_t c = 0; c < impulse_.size(); ++c) {
      const double drag = inertia_.mass_damping_per_s * inertia_.mass[c / 3] * state.v[c];
      impulse_[c] = dt * (external[c] - impulse_[c] - drag);
    }
    implicit_.factor().solve_roughly(impulse_, motion);
    for (std::size_t c = 0; c < impulse_.size(); ++c) motion[c] += state.v[c];
  }
  double elastic_energy(std::span<const double> u) noexcept override { return implicit_.elastic_energy(u); }
  bool remove(std::span<const TetId> tetrahedra) noexcept override { return implicit_.remove(tetrahedra); }
  void restore(std::span<const TetId> /*removed*/) noexcept override { implicit_.restore(); }
  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept override {
    implicit_.compliance(nodes, block);
  }

 private:
  physics::Inertia inertia_;
  physics::ImplicitStep implicit_;
  std::vector<double> impulse_;  // workspace, [3N]
};

class WarpedStepper final : public BodyStepper {
 public:
  WarpedStepper(const SteppedBody& body, double step_s)
      : warped_(body.mesh, body.material, body.inertia, physics::Corotational(body.mesh, body.material),
                {.step_s = step_s, .most_compliance_nodes = kPatchNodes}) {}

  double step_s() const override { return warped_.step_s(); }
  Work step(BodyState& state, std::span<const double> external) noexcept override {
    if (!warped_.step(state, external)) return {};
    return work_of(external, state, step_s());
  }
  double elastic_energy(std::span<const double> u) noexcept override { return warped_.law().energy(u); }
  bool remove(std::span<const TetId> tetrahedra) noexcept override { return warped_.remove(tetrahedra); }
  void restore(std::span<const TetId> /*removed*/) noexcept override { warped_.restore(); }
  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept override {
    warped_.compliance(nodes, block);
  }

 private:
  physics::WarpedStep warped_;
};

class ExplicitStepper final : public BodyStepper {
 public:
  ExplicitStepper(const SteppedBody& body, std::unique_ptr<ForceLaw> law, physics::ExplicitScheme scheme,
                  double step_s)
      : inertia_(body.inertia),
        law_(std::move(law)),
        explicit_(scheme, inertia_),
        step_s_(step_s),
        felt_(implicit_of(body, kFeltStep_s)) {}

  double step_s() const override { return step_s_; }
  Work step(BodyState& state, std::span<const double> external) noexcept override {
    return finite(explicit_.step(*law_, external, step_s_, state));
  }
  Work step_shorter(BodyState& state, std::span<const double> external) noexcept override {
    double work_j = 0;
    for (int i = 0; i < kShorter; ++i) work_j += explicit_.step(*law_, external, step_s_ / kShorter, state);
    return finite(work_j);
  }
  double elastic_energy(std::span<const double> u) noexcept override { return law_->energy(u); }
  bool remove(std::span<const TetId> tetrahedra) noexcept override {
    for (const TetId t : tetrahedra) law_->remove(t);
    return felt_.remove(tetrahedra);
  }
  void restore(std::span<const TetId> removed) noexcept override {
    for (const TetId t : removed) law_->add(t);
    felt_.restore();
  }
  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept override {
    felt_.compliance(nodes, block);
  }

 private:
  static Work finite(double work_j) { return std::isfinite(work_j) ? Work(work_j) : std::nullopt; }

  physics::Inertia inertia_;
  std::unique_ptr<ForceLaw> law_;
  physics::ExplicitStep explicit_;
  double step_s_;
  physics::ImplicitStep felt_;
};

}  // namespace

std::unique_ptr<BodyStepper> make_implicit_stepper(const SteppedBody& body, double step_s) {
  return std::make_unique<ImplicitStepper>(body, step_s);
}

std::unique_ptr<BodyStepper> make_warped_stepper(const SteppedBody& body, double step_s) {
  return std::make_unique<WarpedStepper>(body, step_s);
}

std::unique_ptr<BodyStepper> make_explicit_stepper(const SteppedBody& body, std::unique_ptr<ForceLaw> law,
                                                   physics::ExplicitScheme scheme, double step_s) {
  return std::make_unique<ExplicitStepper>(body, std::move(law), scheme, step_s);
}

}  // namespace omentum::deform
