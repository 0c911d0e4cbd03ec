#include "deform_node/gut_meeting.h"

#include <algorithm>
#include <utility>

namespace omentum::deform {

GutMeeting::GutMeeting(const physics::GutSystem& felt)
    : felt_(felt),
      band_(felt.springs(), felt.settings().step_s),
      springs_(felt.springs(), band_, felt.settings().step_s, felt.settings().iterations),
      spheres_(felt.shape(), felt.springs().mass()),
      impulses_(felt.state().x.size(), Vec3::Zero()),
      forces_(impulses_.size()),
      unpushed_(impulses_.size()),
      ahead_of_none_(impulses_.size()),
      moved_(felt.state()) {}

// Into moved_, under weight, `forces_n` and what organs pushed so far.
void GutMeeting::step_springs(const physics::GutState& state, std::span<const Vec3> forces_n) noexcept {
  const physics::GutStepSettings& settings = felt_.settings();
  for (std::size_t m = 0; m < forces_.size(); ++m)
    forces_[m] =
        felt_.springs().mass()[m] * settings.gravity_m_s2 + forces_n[m] + impulses_[m] / settings.step_s;
  moved_ = state;
  springs_.step(forces_, moved_);
}

void GutMeeting::respond(std::span<const OrganContact> contacts, const physics::GutState& state,
                         std::span<const Vec3> forces_n, std::span<Vec3> ahead) noexcept {
  if (!std::exchange(meets_, true)) {
    step_springs(state, forces_n);
    unpushed_ = moved_.x;
    std::ranges::copy(ahead, ahead_of_none_.begin());
  }
  spheres_.push(contacts, impulses_);
  step_springs(state, forces_n);
  for (std::size_t m = 0; m < ahead.size(); ++m)
    ahead[m] = ahead_of_none_[m] + (moved_.x[m] - unpushed_[m]) / felt_.settings().step_s;
}

void GutMeeting::act(double seconds) noexcept {
  has_met_ = meets_;
  if (!std::exchange(meets_, false)) return;
  acts_ = true;
  for (std::size_t m = 0; m < forces_.size(); ++m)
    forces_[m] = std::exchange(impulses_[m], Vec3::Zero()) / seconds;
}

std::span<const Vec3> GutMeeting::forces() const noexcept {
  return acts_ ? std::span(forces_) : std::span<const Vec3>();
}

void GutMeeting::put_down() noexcept {
  acts_ = false;
}

void GutMeeting::reset() noexcept {
  meets_ = has_met_ = acts_ = false;
  std::ranges::fill(impulses_, Vec3::Zero());
}

}  // namespace omentum::deform
