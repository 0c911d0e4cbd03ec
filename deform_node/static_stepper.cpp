// A body without masses: where its forces balance, it is at once. What is cut off may have masses.
#include "deform_node/falling_pieces.h"
#include "physics/static_factor.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

using geometry::NodeId;
using geometry::TetId;
using physics::BodyState;

bool is_zero(std::span<const double> forces) {
  return std::ranges::all_of(forces, [](double f) { return f == 0; });
}

// What a force does within a step is all that it ever does.
class StaticStepper final : public BodyStepper, private physics::Yielding {
 public:
  StaticStepper(const SteppedBody& body, double step_s, LoosePieces loose)
      : factor_(body.mesh, body.material, body.inertia.fixed, kPatchNodes),
        falling_(loose == LoosePieces::kFall ? std::make_unique<FallingPieces>(body, step_s) : nullptr),
        step_s_(step_s),
        imposed_(body.mesh.positions.size(), kMaxTools),
        before_(3 * body.mesh.positions.size()),
        forces_(before_.size()),
        held_(before_.size()),
        mass_(body.mesh.positions.size()) {
    taken_.reserve(body.mesh.tetrahedra.size());
    let_go_.reserve(body.mesh.tetrahedra.size());
  }

  double step_s() const override { return step_s_; }
  std::span<const double> mass() const noexcept override { return mass_; }

  std::optional<double> step(BodyState& state, BodyLoads& loads) noexcept override {
    std::ranges::copy(state.u, before_.begin());
    if (falls() && !falling_->step(state, loads.weights())) return {};
    yield_held(loads.weights(), state.u);
    if (falls()) {
      falling_->put(falling_->state().u, state.u);
      falling_->put(falling_->state().v, state.v);
    }
    loads.act(imposed_.impose(*this, loads.presses(), state.u, state.v));
    double work_j = 0;
    for (std::size_t c = 0; c < before_.size(); ++c) {
      if (!falls() || !falling_->has(NodeId(c / 3))) state.v[c] = (state.u[c] - before_[c]) / step_s_;
      work_j += loads.external()[c] * (state.u[c] - before_[c]);
    }
    return std::isfinite(work_j) ? std::optional(work_j) : std::nullopt;
  }

  double elastic_energy(std::span<const double> u) noexcept override {
    const std::span<const double> held = held_of(u);
    factor_.holding_forces(held, forces_);
    double twice_j = 0;
    for (std::size_t c = 0; c < held.size(); ++c) twice_j += held[c] * forces_[c];
    return twice_j / 2 + (falls() ? falling_->elastic_energy(u) : 0);
  }

  void let_go(std::span<const TetId> tetrahedra) noexcept override {
    falling_->let_go(tetrahedra);
    let_go_.assign(tetrahedra.begin(), tetrahedra.end());
  }
  bool remove(std::span<const TetId> tetrahedra) noexcept override {
    if (!falling_) return factor_.remove(tetrahedra);
    // what falls has left the factor already, or leaves it now, whole
    taken_.assign(let_go_.begin(), let_go_.end());
    let_go_.clear();
    std::ranges::copy_if(tetrahedra, std::back_inserter(taken_), [&](TetId t) { return !falling_->has(t); });
    const bool falls_soundly = falling_->remove(tetrahedra);
    falling_->put_mass(mass_);
    return factor_.remove(taken_) && falls_soundly;
  }
  void restore(std::span<const TetId> /*removed*/) noexcept override {
    factor_.restore();
    std::ranges::fill(mass_, 0.0);
    let_go_.clear();
    if (falling_) falling_->restore();
  }

  void compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept override {
    const auto is_falling = [&](NodeId n) { return falls() && falling_->has(n); };
    if (!std::ranges::all_of(nodes, is_falling)) factor_.compliance(nodes, block);
    if (std::ranges::any_of(nodes, is_falling)) falling_->compliance(nodes, block);
  }
  void foresee(const BodyState& state, std::span<const double> external,
               std::span<double> u) noexcept override {
    std::ranges::copy(state.u, u.begin());
    if (falls()) falling_->foresee(state, external, u);
  }
  void yield_to(std::span<const double> forces, std::span<double> yield) noexcept override {
    const std::span<const double> pieces =
        falls() ? falling_->yield_to(forces, yield) : std::span<const double>();
    yield_held(forces, yield);
    if (falls()) falling_->put(pieces, yield);
  }

 private:
  bool falls() const noexcept { return falling_ && falling_->any(); }
  // Without what falls.
  std::span<const double> held_of(std::span<const double> all) noexcept {
    if (!falls()) return all;
    falling_->leave_out(all, held_);
    return held_;
  }
  void yield_held(std::span<const double> forces, std::span<double> yield) noexcept {
    const std::span<const double> held = held_of(forces);
    // most organs lie in their bed, and nothing but hands loads them
    if (is_zero(held)) {
      std::ranges::fill(yield, 0.0);
    } else {
      factor_.solve(held, yield);
    }
  }

  physics::StaticFactor factor_;
  std::unique_ptr<FallingPieces> falling_;  // null: what is cut off is dropped
  double step_s_;
  physics::ImposedPress imposed_;
  std::vector<double> before_, forces_, held_;  // [3N]
  std::vector<double> mass_;                    // [N], zero where nothing falls
  std::vector<TetId> taken_, let_go_;           // capacity T
};

}  // namespace

std::unique_ptr<BodyStepper> make_static_stepper(const SteppedBody& body, double step_s, LoosePieces loose) {
  return std::make_unique<StaticStepper>(body, step_s, loose);
}

}  // namespace omentum::deform
