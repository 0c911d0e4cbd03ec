#include "deform_node/falling_pieces.h"

#include "deform_node/parted_tissue.h"

#include <algorithm>

namespace omentum::deform {

using geometry::TetId;

FallingPieces::FallingPieces(const SteppedBody& body, double step_s)
    : mesh_(body.mesh),
      warped_(body.mesh, body.material, PartedTissue::without_supports(body.inertia),
              physics::Corotational(body.mesh, body.material),
              {.step_s = step_s, .most_compliance_nodes = BodyStepper::kPatchNodes}),
      has_node_(body.mesh.positions.size()),
      has_tetrahedron_(body.mesh.tetrahedra.size()),
      state_(physics::state_at_rest(has_node_.size())),
      here_(state_),
      forces_(state_.u.size()),
      yield_(state_.u.size()),
      block_(9 * static_cast<std::size_t>(BodyStepper::kPatchNodes) * BodyStepper::kPatchNodes) {}

void FallingPieces::let_go(std::span<const TetId> tetrahedra) noexcept {
  for (const TetId t : tetrahedra) {
    has_tetrahedron_[t] = true;
    for (const NodeId n : mesh_.tetrahedra[t]) has_node_[n] = true;
  }
  any_ = any_ || !tetrahedra.empty();
}

bool FallingPieces::remove(std::span<const TetId> tetrahedra) noexcept {
  return warped_.remove(tetrahedra);
}

void FallingPieces::restore() noexcept {
  warped_.restore();
  any_ = false;
  std::fill(has_node_.begin(), has_node_.end(), false);
  std::fill(has_tetrahedron_.begin(), has_tetrahedron_.end(), false);
}

bool FallingPieces::step(const physics::BodyState& state, std::span<const double> external) noexcept {
  keep(state.u, state_.u);
  keep(state.v, state_.v);
  keep(external, forces_);
  return warped_.step(state_, forces_);
}

double FallingPieces::elastic_energy(std::span<const double> u) noexcept {
  keep(u, yield_);
  return warped_.elastic_energy(yield_);
}

std::span<const double> FallingPieces::yield_to(std::span<const double> forces,
                                                std::span<const double> guess) noexcept {
  keep(forces, forces_);
  keep(guess, yield_);
  warped_.yield_to(forces_, yield_);
  return yield_;
}

void FallingPieces::foresee(const physics::BodyState& state, std::span<const double> external,
                            std::span<double> u) noexcept {
  keep(state.u, here_.u);
  keep(state.v, here_.v);
  keep(external, forces_);
  warped_.foresee(here_, forces_, yield_);
  put(yield_, u);
}

void FallingPieces::compliance(std::span<const NodeId> nodes, std::span<float> block) noexcept {
  const std::size_t rows = 3 * nodes.size();
  warped_.compliance(nodes, block_);
  for (std::size_t r = 0; r < rows; ++r) {
    const bool falls = has(nodes[r / 3]);
    for (std::size_t c = 0; c < rows; ++c) {
      if (falls && has(nodes[c / 3])) block[r * rows + c] = block_[r * rows + c];
      if (falls != has(nodes[c / 3])) block[r * rows + c] = 0;  // nothing ties them
    }
  }
}

void FallingPieces::put(std::span<const double> from, std::span<double> to) const noexcept {
  for (std::size_t c = 0; c < to.size(); ++c)
    if (has_node_[c / 3]) to[c] = from[c];
}

void FallingPieces::leave_out(std::span<const double> from, std::span<double> to) const noexcept {
  for (std::size_t c = 0; c < to.size(); ++c) to[c] = has_node_[c / 3] ? 0 : from[c];
}

void FallingPieces::put_mass(std::span<double> mass) const noexcept {
  for (std::size_t n = 0; n < mass.size(); ++n)
    if (has_node_[n]) mass[n] = warped_.mass()[n];
}

void FallingPieces::keep(std::span<const double> from, std::span<double> to) const noexcept {
  for (std::size_t c = 0; c < to.size(); ++c) to[c] = has_node_[c / 3] ? from[c] : 0;
}

}  // namespace omentum::deform
