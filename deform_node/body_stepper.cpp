#include "deform_node/body_stepper.h"

#include <utility>

namespace omentum::deform {

using geometry::TetId;

BodyStepper::BodyStepper(const geometry::TetraMesh& mesh, const physics::MaterialMap& material,
                         const physics::Inertia& inertia, StepperParts parts)
    : law_(std::move(parts.law)),
      implicit_(mesh, material, inertia,
                {.step_s = parts.step_s, .most_compliance_nodes = parts.most_compliance_nodes}) {}

std::optional<double> BodyStepper::step(physics::BodyState& state,
                                        std::span<const double> external) noexcept {
  if (!(law_ ? implicit_.step(state, *law_, external) : implicit_.step(state, external))) return {};
  double power_w = 0;
  for (std::size_t c = 0; c < external.size(); ++c) power_w += external[c] * state.v[c];
  return power_w * step_s();
}

double BodyStepper::elastic_energy(std::span<const double> u) noexcept {
  return law_ ? law_->energy(u) : implicit_.elastic_energy(u);
}

bool BodyStepper::remove(std::span<const TetId> tetrahedra) noexcept {
  if (law_)
    for (const TetId t : tetrahedra) law_->remove(t);
  return implicit_.remove(tetrahedra);
}

void BodyStepper::restore(std::span<const TetId> removed) noexcept {
  if (law_)
    for (const TetId t : removed) law_->add(t);
  implicit_.restore();
}

}  // namespace omentum::deform
