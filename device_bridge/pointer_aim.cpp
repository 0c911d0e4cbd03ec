#include "device_bridge/pointer_aim.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace omentum::device {
namespace {

constexpr double kUnitSlack = 1e-3;    // of lengths and cosines: rays are computed in single precision
constexpr double kLeastForward = 0.1;  // cosine of a ray with the middle of the view: 84 degrees

// Beyond these a ray is a fault of whoever sent it, and sums of such numbers are none: nobody looks at an
// organ from a kilometre away, m, nor turns a wheel by a million steps.
constexpr double kFarthestEye_m = 1e3, kMostWheel = 1e6;

bool is_unit(const msg::Vec3& v) {
  return std::abs(from_message(v).norm() - 1) < kUnitSlack;  // false for what is not finite
}

// A ray in its own picture.
struct Sight {
  explicit Sight(const msg::PointerRay& ray)
      : direction(from_message(ray.direction)),
        right(from_message(ray.right)),
        up(from_message(ray.up)),
        forward(up.cross(right)),
        a(direction.dot(right) / direction.dot(forward)),
        b(direction.dot(up) / direction.dot(forward)) {}
  Vec3 direction, right, up, forward;
  double a, b;  // tangents to the right and up
};

}  // namespace

bool is_ray(const msg::PointerRay& ray) noexcept {
  if (!is_unit(ray.direction) || !is_unit(ray.right) || !is_unit(ray.up)) return false;
  // false for what is not finite
  if (!(from_message(ray.origin).norm() <= kFarthestEye_m) || !(std::abs(ray.wheel) <= kMostWheel))
    return false;
  const Vec3 right = from_message(ray.right), up = from_message(ray.up);
  return std::abs(right.dot(up)) < kUnitSlack &&
         up.cross(right).dot(from_message(ray.direction)) > kLeastForward;
}

void PointerAim::start(const Vec3& place) noexcept {
  wanted_ = place;
  tilt_.setZero();
  roll_ = 0;
  before_.reset();
}

void PointerAim::give_up_beyond(const Vec3& most, const Vec3& along) noexcept {
  wanted_ -= std::max(0.0, (wanted_ - most).dot(along)) * along;
}

void PointerAim::take(const msg::PointerRay& ray, std::int64_t now_ns) noexcept {
  if (!is_ray(ray)) return;
  if (!ray.valid) {
    before_.reset();
    return;
  }
  // a window that began anew counts its wheel from zero
  if (goes_on(now_ns) && ray.seq > before_->seq) {
    const double seconds = 1e-9 * static_cast<double>(now_ns - before_ns_);
    follow(ray, std::min(seconds, kRaysSilent_s));
  }
  before_ = ray;
  before_ns_ = now_ns;
}

void PointerAim::follow(const msg::PointerRay& ray, double seconds) noexcept {
  const Sight before(*before_), now(ray);
  const double right = now.a - before.a, up = now.b - before.b;
  if ((ray.keys & msg::POINTER_KEY_TILT) != 0) {
    // about the tip: the handle goes where the pointer goes
    tilt_ += kTiltPerTangent * (right * now.up - up * now.right);
  } else {
    const double depth = std::max(0.0, (wanted_ - from_message(ray.origin)).dot(now.forward));
    const Vec3 way = depth * (right * now.right + up * now.up);
    wanted_ += way;
    const Vec3 apart =
        from_message(ray.origin) + depth * (now.forward + now.a * now.right + now.b * now.up) - wanted_;
    const double far = apart.norm();
    if (far > 0) wanted_ += std::min(1.0, kCatchUp * way.norm() / far) * apart;
  }
  const auto key = [&](std::uint32_t bit) { return (ray.keys & bit) != 0 ? seconds : 0.0; };
  const double in = kWheelStep_m * (ray.wheel - before_->wheel) +
                    kKeyDepth_m_s * (key(msg::POINTER_KEY_AWAY) - key(msg::POINTER_KEY_NEAR));
  wanted_ += in * now.direction;
  roll_ += kKeyRoll_rad_s * (key(msg::POINTER_KEY_ROLL_LEFT) - key(msg::POINTER_KEY_ROLL_RIGHT));
}

Vec3 PointerAim::take_tilt() noexcept {
  return std::exchange(tilt_, Vec3::Zero());
}

bool PointerAim::goes_on(std::int64_t now_ns) const noexcept {
  return before_ && 1e-9 * static_cast<double>(now_ns - before_ns_) <= kWindowGone_s;
}

const msg::PointerRay* PointerAim::ray(std::int64_t now_ns) const noexcept {
  if (!before_ || 1e-9 * static_cast<double>(now_ns - before_ns_) > kRaysSilent_s) return nullptr;
  return &*before_;
}

}  // namespace omentum::device
