#include "deform_node/body_stepper.h"

#include <cmath>
#include <utility>

namespace omentum::deform {

using geometry::TetId;

namespace {

std::optional<double> finite(double work_j) {
  return std::isfinite(work_j) ? std::optional(work_j) : std::nullopt;
}

}  // namespace

BodyStepper::BodyStepper(const geometry::TetraMesh& mesh, const physics::MaterialMap& material,
                         const physics::Inertia& inertia, StepperParts parts)
    : inertia_(inertia),
      law_(std::move(parts.law)),
      step_s_(parts.step_s),
      implicit_(mesh, material, inertia_,
                {.step_s = parts.scheme ? kFeltStep_s : parts.step_s,
                 .most_compliance_nodes = parts.most_compliance_nodes}) {
  if (parts.scheme) explicit_.emplace(*parts.scheme, inertia_);
}

std::optional<double> BodyStepper::step(physics::BodyState& state,
                                        std::span<const double> external) noexcept {
  if (explicit_) return finite(explicit_->step(*law_, external, step_s_, state));
  if (!(law_ ? implicit_.step(state, *law_, external) : implicit_.step(state, external))) return {};
  double power_w = 0;
  for (std::size_t c = 0; c < external.size(); ++c) power_w += external[c] * state.v[c];
  return power_w * step_s_;
}

std::optional<double> BodyStepper::step_shorter(physics::BodyState& state,
                                                std::span<const double> external) noexcept {
  double work_j = 0;
  for (int i = 0; i < kShorter; ++i) work_j += explicit_->step(*law_, external, step_s_ / kShorter, state);
  return finite(work_j);
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
