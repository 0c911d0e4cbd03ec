#include "deform_node/body_stepper.h"

#include "physics/dynamics/corotational.h"
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

std::unique_ptr<physics::LargeStep> implicit_of(const SteppedBody& body, double step_s) {
  return std::make_unique<physics::ImplicitStep>(
      body.mesh, body.material, body.inertia,
      physics::ImplicitOptions{.step_s = step_s, .most_compliance_nodes = BodyStepper::kPatchNodes});
}

std::unique_ptr<physics::LargeStep> warped_of(const SteppedBody& body, double step_s) {
  return std::make_unique<physics::WarpedStep>(
      body.mesh, body.material, body.inertia, physics::Corotational(body.mesh, body.material),
      physics::WarpedOptions{.step_s = step_s, .most_compliance_nodes = BodyStepper::kPatchNodes});
}

class LargeStepper final : public BodyStepper {
 public:
  LargeStepper(std::size_t node_count, std::unique_ptr<physics::LargeStep> large)
      : large_(std::move(large)), imposed_(node_count, kMaxTools) {}

  double step_s() const override { return large_->step_s(); }
  std::span<const double> mass() const noexcept override { return large_->mass(); }
  Work step(BodyState& state, BodyLoads& loads) noexcept override {
    if (!large_->step(state, loads.weights())) return {};
    loads.act(imposed_.impose(*large_, loads.presses(), state));
    return large_->work(loads.external(), state.v);
  }
  Work step_shorter(BodyState& state, BodyLoads& loads) noexcept override {
    if (!large_->step_again(state, loads.external())) return {};
    return large_->work(loads.external(), state.v);
  }
  bool shortens() const noexcept override { return false; }
  double elastic_energy(std::span<const double> u) noexcept override { return large_->elastic_energy(u); }
  bool remove(std::span<const TetId> tetrahedra) noexcept override { return large_->remove(tetrahedra); }
  void let_go(std::span<const TetId> tetrahedra) noexcept override { large_->let_go(tetrahedra); }
  void restore(std::span<const TetId> /*removed*/) noexcept override { large_->restore(); }
  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept override {
    large_->compliance(nodes, block);
  }
  void foresee(const BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept override {
    large_->foresee(state, external, u);
  }
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override {
    large_->yield_to(forces, yield);
  }

 private:
  std::unique_ptr<physics::LargeStep> large_;
  physics::ImposedPress imposed_;
};

class ExplicitStepper final : public BodyStepper {
 public:
  ExplicitStepper(const SteppedBody& body, std::unique_ptr<ForceLaw> law, physics::ExplicitScheme scheme,
                  double step_s, bool is_felt)
      : inertia_(body.inertia),
        law_(std::move(law)),
        explicit_(scheme, inertia_),
        step_s_(step_s),
        is_felt_(is_felt),
        felt_(body.mesh, body.material, inertia_,
              {.step_s = kFeltStep_s, .most_compliance_nodes = kPatchNodes, .sheds_mass = false}),
        imposed_(inertia_.mass.size(), kMaxTools),
        ahead_(physics::state_at_rest(inertia_.mass.size())) {}

  double step_s() const override { return step_s_; }
  std::span<const double> mass() const noexcept override { return inertia_.mass; }
  void prepare() noexcept override { until_felt_s_ = 0; }
  Work step(BodyState& state, BodyLoads& loads) noexcept override {
    follow(state, loads);
    return finite(explicit_.step(*law_, loads.external(), step_s_, state));
  }
  Work step_shorter(BodyState& state, BodyLoads& loads) noexcept override {
    double work_j = 0;
    follow(state, loads);
    for (int i = 0; i < kShorter; ++i)
      work_j += explicit_.step(*law_, loads.external(), step_s_ / kShorter, state);
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
  bool is_felt() const override { return is_felt_; }
  double felt_s() const override { return felt_.step_s(); }
  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept override {
    felt_.compliance(nodes, block);
  }
  void foresee(const BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept override {
    felt_.foresee(state, *law_, external, u);
  }
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override {
    felt_.yield_to(forces, yield);
  }

 private:
  // How strong presses are until the body can be where hands want it.
  void follow(const BodyState& state, BodyLoads& loads) noexcept {
    until_felt_s_ -= step_s_;
    if (until_felt_s_ > 0 || loads.presses().empty()) return;
    until_felt_s_ = kFeltStep_s;
    felt_.foresee(state, *law_, loads.weights(), ahead_.u);
    loads.act(imposed_.impose(felt_, loads.presses(), ahead_));
  }
  static Work finite(double work_j) { return std::isfinite(work_j) ? Work(work_j) : std::nullopt; }

  physics::Inertia inertia_;
  std::unique_ptr<ForceLaw> law_;
  physics::ExplicitStep explicit_;
  double step_s_;
  bool is_felt_;
  physics::ImplicitStep felt_;
  physics::ImposedPress imposed_;
  BodyState ahead_;  // of which only u counts
  double until_felt_s_ = 0;
};

}  // namespace

std::unique_ptr<BodyStepper> make_implicit_stepper(const SteppedBody& body, double step_s) {
  return make_large_stepper(body.mesh.positions.size(), implicit_of(body, step_s));
}

std::unique_ptr<BodyStepper> make_large_stepper(std::size_t node_count,
                                                std::unique_ptr<physics::LargeStep> step) {
  return std::make_unique<LargeStepper>(node_count, std::move(step));
}

std::unique_ptr<BodyStepper> make_warped_stepper(const SteppedBody& body, double step_s) {
  return make_large_stepper(body.mesh.positions.size(), warped_of(body, step_s));
}

std::unique_ptr<BodyStepper> make_explicit_stepper(const SteppedBody& body, std::unique_ptr<ForceLaw> law,
                                                   physics::ExplicitScheme scheme, double step_s,
                                                   bool is_linear_at_rest) {
  return std::make_unique<ExplicitStepper>(body, std::move(law), scheme, step_s, is_linear_at_rest);
}

}  // namespace omentum::deform
