// A body without masses: where its forces balance, it is at once.
#include "deform_node/body_stepper.h"

#include "physics/static_factor.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

using geometry::NodeId;
using geometry::TetId;
using physics::BodyState;

// What a force does within a step is all that it ever does.
class StaticStepper final : public BodyStepper, private physics::Yielding {
 public:
  StaticStepper(const SteppedBody& body, double step_s)
      : factor_(body.mesh, body.material, body.inertia.fixed, kPatchNodes),
        step_s_(step_s),
        imposed_(body.mesh.positions.size(), kMaxTools),
        before_(3 * body.mesh.positions.size()),
        forces_(before_.size()) {}

  double step_s() const override { return step_s_; }

  std::optional<double> step(BodyState& state, BodyLoads& loads) noexcept override {
    std::ranges::copy(state.u, before_.begin());
    yield_to(loads.weights(), state.u);
    loads.act(imposed_.impose(*this, loads.presses(), state.u, state.v));
    double work_j = 0;
    for (std::size_t c = 0; c < before_.size(); ++c) {
      state.v[c] = (state.u[c] - before_[c]) / step_s_;
      work_j += loads.external()[c] * (state.u[c] - before_[c]);
    }
    return std::isfinite(work_j) ? std::optional(work_j) : std::nullopt;
  }

  double elastic_energy(std::span<const double> u) noexcept override {
    factor_.holding_forces(u, forces_);
    double twice_j = 0;
    for (std::size_t c = 0; c < u.size(); ++c) twice_j += u[c] * forces_[c];
    return twice_j / 2;
  }

  bool remove(std::span<const TetId> tetrahedra) noexcept override { return factor_.remove(tetrahedra); }
  void restore(std::span<const TetId> /*removed*/) noexcept override { factor_.restore(); }

  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept override {
    factor_.compliance(nodes, block);
  }
  void foresee(const BodyState& state, std::span<const double> /*external*/,
               std::span<double> u) noexcept override {
    std::ranges::copy(state.u, u.begin());
  }
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override {
    // most organs lie in their bed, and nothing but hands loads them
    if (std::ranges::all_of(forces, [](double f) { return f == 0; })) {
      std::ranges::fill(yield, 0.0);
    } else {
      factor_.solve(forces, yield);
    }
  }

 private:
  physics::StaticFactor factor_;
  double step_s_;
  physics::ImposedPress imposed_;
  std::vector<double> before_, forces_;  // [3N]
};

}  // namespace

std::unique_ptr<BodyStepper> make_static_stepper(const SteppedBody& body, double step_s) {
  return std::make_unique<StaticStepper>(body, step_s);
}

}  // namespace omentum::deform
