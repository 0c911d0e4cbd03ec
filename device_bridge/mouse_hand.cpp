#include "device_bridge/mouse_hand.h"

#include "device_bridge/glide.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace omentum::device {
namespace {

// Critically damped: nobody's muscles brake a tip that hangs on a pointer.
constexpr double kMouseMass_kg = 0.2, kMouseStiffness_n_m = 400, kMouseDamping_n_s_m = 17.9;
constexpr int kMouseSubsteps = 4;         // as fine as a simulated hand at 1 kHz
constexpr double kFreeReach_m = 0.5;      // from the start, of a tool without a trocar
constexpr double kHandleLength_m = 0.02;  // of the shaft, which stays outside of the trocar

scene::HandSpec mouse_of(const scene::HandSpec& scripted) {
  scene::HandSpec hand = scripted;
  hand.mass_kg = kMouseMass_kg;
  hand.stiffness_n_m = kMouseStiffness_n_m;
  hand.damping_n_s_m = kMouseDamping_n_s_m;
  return hand;
}

Quat about_shaft(double roll_rad) {
  return Quat(Eigen::AngleAxisd(roll_rad, Vec3::UnitZ()));
}

}  // namespace

MouseHand::MouseHand(const scene::HandSpec& hand, const scene::ToolSpec& tool, double rate_hz,
                     const RayInbox& rays, bool waits)
    : hand_(mouse_of(hand)),
      tool_(tool),
      period_s_(1 / rate_hz),
      rays_(rays),
      script_(hand, tool, rate_hz),
      driven_(waits),
      now_(script_.measure(0)),
      start_(now_.position),
      start_turn_(now_.orientation),
      inward_(Vec3::Zero()) {
  if (tool_.trocar) inward_ = (start_ - *tool_.trocar).normalized();
  take_over();
}

msg::DeviceInfo MouseHand::info() const {
  msg::DeviceInfo info = script_.info();
  info.name = "mouse";
  info.damping_n_s_m = hand_.damping_n_s_m;
  return info;
}

void MouseHand::command(const Wrench& wrench) noexcept {
  wrench_ = wrench;
  script_.command(wrench);
}

Measurement MouseHand::measure(std::int64_t now_ns) noexcept {
  hear(now_ns);
  if (!driven_) return now_ = script_.measure(now_ns);
  for (int i = 0; i < kMouseSubsteps; ++i) advance(period_s_ / kMouseSubsteps);
  const Quat before = now_.orientation;
  now_.valid = true;
  now_.measured_ns = now_ns;
  now_.position = tip_.position;
  now_.orientation = turn(period_s_);
  now_.linear_velocity = tip_.velocity;
  now_.angular_velocity = angular_velocity(before, now_.orientation, period_s_);
  use(now_ns, period_s_);
  peak_force_n_ = std::max(peak_force_n_, wrench_.force.norm());
  peak_grip_torque_nm_ = std::max(peak_grip_torque_nm_, std::abs(wrench_.grip_torque));
  return now_;
}

void MouseHand::hear(std::int64_t now_ns) noexcept {
  transport::Arrived<msg::PointerRay> newest;
  if (!rays_.load(tool_.id, newest) || newest.arrived_ns == heard_ns_ || paused_) return;
  heard_ns_ = newest.arrived_ns;
  const msg::PointerRay& ray = newest.sample;
  // one that came before this hand was ready is not of this moment
  if (1e-9 * static_cast<double>(now_ns - heard_ns_) > kRaysSilent_s) return;
  if (ray.valid && is_ray(ray)) {
    ++followed_;
    if (!driven_) take_over();
    driven_ = true;
  }
  // the mouse comes, or comes back
  if (ray.valid && !aim_.goes_on(now_ns)) jaws_left_ = true;
  aim_.take(ray, heard_ns_);
  aim_.correct(within_reach(aim_.wanted()));
  const Vec3 tilt = aim_.take_tilt();
  if (const double angle = tilt.norm(); angle > 0)
    wanted_turn_ = (Quat(Eigen::AngleAxisd(angle, tilt / angle)) * wanted_turn_).normalized();
}

// The spring's other end is where it bears what is felt now: the tip does not notice who holds it.
void MouseHand::take_over() noexcept {
  tip_ = {now_.position, now_.linear_velocity};
  target_ = {now_.position - wrench_.force / hand_.stiffness_n_m, Vec3::Zero()};
  aim_.start(target_.position);
  turn_ = wanted_turn_ = now_.orientation;
  roll_ = 0;
  jaws_left_ = true;
}

void MouseHand::advance(double dt_s) noexcept {
  target_ = glide(target_, aim_.wanted(), dt_s);
  hold_back();
  tip_ = step_hand(hand_, tip_, target_, wrench_.force, dt_s);
}

void MouseHand::hold_back() noexcept {
  const Vec3 pull = target_.position - tip_.position;
  const double far = pull.norm(), most = kMousePull_n / hand_.stiffness_n_m;
  if (far <= most) return;
  const Vec3 along = pull / far;
  target_.position = tip_.position + most * along;
  target_.velocity -= std::max(0.0, target_.velocity.dot(along)) * along;
  aim_.give_up_beyond(target_.position, along);
}

Vec3 MouseHand::within_reach(const Vec3& place) const noexcept {
  const Vec3 pivot = tool_.trocar.value_or(start_);
  const double longest = tool_.trocar ? tool_.shaft_length_m - kHandleLength_m : kFreeReach_m;
  Vec3 arm = place - pivot;
  if (tool_.trocar) arm += std::max(0.0, kLeastInsertion_m - arm.dot(inward_)) * inward_;
  const double length = arm.norm();
  return pivot + (length > longest ? Vec3(arm * (longest / length)) : arm);
}

Quat MouseHand::turn(double dt_s) noexcept {
  const double most = kMouseTurn_rad_s * dt_s;
  roll_ += std::clamp(aim_.roll() - roll_, -most, most);
  if (tool_.trocar) return shaft_orientation(*tool_.trocar - tip_.position) * about_shaft(roll_);
  turn_ = turn_towards(turn_, wanted_turn_, kMouseTurn_rad_s, dt_s);
  return turn_ * about_shaft(roll_);
}

// What the buttons do.
void MouseHand::use(std::int64_t now_ns, double dt_s) noexcept {
  const msg::PointerRay* const ray = aim_.ray(now_ns);
  const auto pressed = [&](std::uint32_t button, std::uint32_t key) {
    return ray != nullptr && !paused_ && ((ray->buttons & button) != 0 || (ray->keys & key) != 0);
  };
  const bool cuts = !tool_.edge.empty();
  now_.buttons = cuts && pressed(msg::POINTER_LEFT, msg::POINTER_KEY_CUT) ? msg::BUTTON_CUT : 0;
  if (tool_.shape != "grasper") return;
  const bool closes =
      pressed(cuts ? msg::POINTER_RIGHT : msg::POINTER_RIGHT | msg::POINTER_LEFT, msg::POINTER_KEY_CLOSE);
  if (closes) jaws_left_ = false;
  JawWish wish = closes ? JawWish::kClose : JawWish::kOpen;
  if (ray == nullptr || jaws_left_ || paused_) wish = JawWish::kStay;
  now_.grip = step_jaws(now_.grip, wish, wrench_.grip_torque, dt_s);
}

void MouseHand::pause(bool paused) noexcept {
  paused_ = paused;
  if (paused_) aim_.let_go();
  script_.pause(paused);
}

void MouseHand::restart() noexcept {
  script_.restart();
  if (!driven_) return;
  aim_.start(start_);
  wanted_turn_ = start_turn_;
}

nlohmann::json MouseHand::report() const {
  return {{"tool", tool_.id},
          {"peak_force_n", peak_force_n_},
          {"peak_grip_torque_nm", peak_grip_torque_nm_},
          {"rays", followed_}};
}

}  // namespace omentum::device
