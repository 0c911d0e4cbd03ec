#include "deform_node/body_meeting.h"

#include <algorithm>
#include <utility>

namespace omentum::deform {

using physics::BodyState;

BodyMeeting::BodyMeeting(const geometry::TetraMesh& mesh, const physics::Inertia& inertia)
    : spheres_(mesh, inertia),
      ahead_(3 * mesh.positions.size()),
      places_(ahead_.size()),
      impulses_(ahead_.size()),
      latest_(ahead_.size()) {}

std::span<const CollisionSphere> BodyMeeting::collidable(const Cut& cut, const BodyState& state,
                                                         BodyStepper& stepper,
                                                         std::span<const double> external) noexcept {
  if (version_ != cut.version) spheres_.part(cut.editor, stepper.mass());
  version_ = cut.version;
  // who met nobody lately saves the solve
  if (!meets_ && !has_met_) return spheres_.follow(state, state.v);
  look_ahead(state, stepper, external);
  return spheres_.follow(state, ahead_);
}

void BodyMeeting::look_ahead(const BodyState& state, BodyStepper& stepper,
                             std::span<const double> external) noexcept {
  if (is_ahead_) return;
  stepper.foresee(state, external, places_);
  for (std::size_t c = 0; c < ahead_.size(); ++c) ahead_[c] = (places_[c] - state.u[c]) / stepper.felt_s();
  is_ahead_ = true;
}

void BodyMeeting::respond(std::span<const OrganContact> contacts, const BodyState& state,
                          BodyStepper& stepper, std::span<const double> external) noexcept {
  meets_ = true;
  look_ahead(state, stepper, external);
  std::ranges::fill(latest_, 0.0);
  spheres_.push(contacts, latest_);
  for (std::size_t c = 0; c < latest_.size(); ++c) impulses_[c] += latest_[c];
  const double step_s = stepper.felt_s();
  for (double& force : latest_) force /= step_s;
  stepper.yield_to(latest_, places_);
  for (std::size_t c = 0; c < ahead_.size(); ++c) ahead_[c] += places_[c] / step_s;
}

void BodyMeeting::act(double seconds, const geometry::MeshEditor& editor, BodyLoads& loads) noexcept {
  is_ahead_ = false;
  has_met_ = meets_;
  if (!std::exchange(meets_, false)) return;
  for (double& impulse : impulses_) impulse /= seconds;
  loads.carry(impulses_, editor);
  std::ranges::fill(impulses_, 0.0);
}

void BodyMeeting::reset() noexcept {
  meets_ = has_met_ = is_ahead_ = false;
  version_.reset();  // what comes next may be of the same number
  std::ranges::fill(impulses_, 0.0);
}

}  // namespace omentum::deform
