#include "deform_node/gut_meeting.h"

#include <algorithm>
#include <utility>

namespace omentum::deform {

namespace {

// The constant matrix has the springs as if they had no direction: one step with it moves a gut less than all
// iterations of its own steps do, as far along it and a third and less across it.
constexpr double kFarther = 3;

}  // namespace

GutMeeting::GutMeeting(const physics::GutSystem& felt)
    : felt_(felt),
      band_(felt.springs(), felt.settings().step_s),
      springs_(felt.springs(), band_, felt.settings().step_s, felt.settings().iterations),
      spheres_(felt.shape(), felt.springs().mass()),
      impulses_(felt.state().x.size(), Vec3::Zero()),
      latest_(impulses_.size()),
      forces_(impulses_.size()),
      unpushed_(impulses_.size()),
      ahead_of_none_(impulses_.size()),
      near_(impulses_.size()),
      moved_(felt.state()) {}

std::span<const CollisionSphere> GutMeeting::collidable(const physics::GutState& state,
                                                        std::span<const Vec3> ahead) noexcept {
  if (foresees()) return spheres_.follow(state.x, ahead);
  return spheres_.follow(state.x, meets_ ? std::span<const Vec3>(near_) : state.v);
}

// Into moved_, under weight, `forces_n` and what organs pushed so far.
void GutMeeting::step_springs(const physics::GutState& state, std::span<const Vec3> forces_n) noexcept {
  const physics::GutStepSettings& settings = felt_.settings();
  for (std::size_t m = 0; m < forces_.size(); ++m)
    forces_[m] =
        felt_.springs().mass()[m] * settings.gravity_m_s2 + forces_n[m] + impulses_[m] / settings.step_s;
  moved_ = state;
  springs_.step(forces_, moved_);
}

void GutMeeting::foresee_pushes(const physics::GutState& state, std::span<const Vec3> forces_n,
                                std::span<Vec3> ahead) noexcept {
  step_springs(state, forces_n);
  for (std::size_t m = 0; m < ahead.size(); ++m)
    ahead[m] = ahead_of_none_[m] + (moved_.x[m] - unpushed_[m]) / felt_.settings().step_s;
}

// What came on top of the pushes that went on.
void GutMeeting::look_ahead() noexcept {
  const double step_s = felt_.settings().step_s;
  for (std::size_t m = 0; m < latest_.size(); ++m) forces_[m] = latest_[m] / step_s;
  felt_.yield_to(forces_, moved_.x);
  for (std::size_t m = 0; m < near_.size(); ++m) near_[m] += kFarther / step_s * moved_.x[m];
}

void GutMeeting::respond(std::span<const OrganContact> contacts, const physics::GutState& state,
                         std::span<const Vec3> forces_n, std::span<Vec3> ahead) noexcept {
  if (!std::exchange(meets_, true)) std::ranges::copy(state.v, near_.begin());
  meets_body_ |= is_with_body(contacts);
  if (foresees() && !std::exchange(is_unpushed_, true)) {
    std::swap(impulses_, latest_);  // none
    std::ranges::fill(impulses_, Vec3::Zero());
    step_springs(state, forces_n);
    std::swap(impulses_, latest_);
    unpushed_ = moved_.x;
    std::ranges::copy(ahead, ahead_of_none_.begin());
  }
  std::ranges::fill(latest_, Vec3::Zero());
  spheres_.push(contacts, latest_);
  for (std::size_t m = 0; m < latest_.size(); ++m) impulses_[m] += latest_[m];
  if (foresees()) {
    foresee_pushes(state, forces_n, ahead);
  } else if (contacts.empty() || !contacts.front().goes_on) {
    look_ahead();
  }
}

void GutMeeting::act(double seconds) noexcept {
  met_body_ = std::exchange(meets_body_, false);
  is_unpushed_ = false;
  lend(seconds);
  if (std::exchange(meets_, false)) std::ranges::fill(impulses_, Vec3::Zero());
}

void GutMeeting::lend(double seconds) noexcept {
  if (!meets_) return;
  acts_ = true;
  for (std::size_t m = 0; m < forces_.size(); ++m) forces_[m] = impulses_[m] / seconds;
}

std::span<const Vec3> GutMeeting::forces() const noexcept {
  return acts_ ? std::span(forces_) : std::span<const Vec3>();
}

void GutMeeting::put_down() noexcept {
  acts_ = false;
}

void GutMeeting::reset() noexcept {
  meets_ = meets_body_ = met_body_ = is_unpushed_ = acts_ = false;
  std::ranges::fill(impulses_, Vec3::Zero());
}

}  // namespace omentum::deform
