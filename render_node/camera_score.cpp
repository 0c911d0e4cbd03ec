#include "render_node/camera_score.h"

#include "render_node/scope_view.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

// Of the unit view axis: nearer to the upright, within 6 degrees, a picture has no level.
constexpr double kUprightView = 0.1;

double in_degrees(double angle_rad) {
  return angle_rad * 180 / std::numbers::pi;
}

}  // namespace

CameraMoment camera_moment(const Camera& camera, const Vec3& target, bool hidden) {
  const Vec3 forward = camera.forward(), way = target - camera.eye;
  CameraMoment moment;
  moment.off_centre_rad = std::atan2(forward.cross(way).norm(), forward.dot(way));
  moment.in_sight = !hidden && moment.off_centre_rad <= lens_half_angle(camera);
  const Vec3 right = forward.cross(camera.up).normalized(), up = right.cross(forward);
  if (std::hypot(right.z(), up.z()) > kUprightView) moment.roll_rad = std::atan2(right.z(), up.z());
  return moment;
}

void CameraScore::add(double now_s, const CameraMoment& moment) {
  count(now_s);
  before_ = moment;
}

void CameraScore::skip(double now_s) {
  count(now_s);
  before_.reset();
}

void CameraScore::count(double now_s) {
  const double lasted_s = std::min(now_s - before_s_, kLongest_s);
  before_s_ = now_s;
  if (!before_) return;
  seconds_ += lasted_s;
  off_rad_s_ += lasted_s * before_->off_centre_rad;
  largest_off_rad_ = std::max(largest_off_rad_, before_->off_centre_rad);
  if (before_->in_sight) in_sight_s_ += lasted_s;
  if (before_->in_sight && before_->off_centre_rad <= within_rad_) within_s_ += lasted_s;
  if (!before_->roll_rad) return;
  rolled_s_ += lasted_s;
  roll_rad_s_ += lasted_s * std::abs(*before_->roll_rad);
  largest_roll_rad_ = std::max(largest_roll_rad_, std::abs(*before_->roll_rad));
}

nlohmann::json CameraScore::report() const {
  const auto over = [](double sum, double all_s) {
    return all_s > 0 ? nlohmann::json(sum / all_s) : nlohmann::json();
  };
  const auto most = [](double angle_rad, double all_s) {
    return all_s > 0 ? nlohmann::json(in_degrees(angle_rad)) : nlohmann::json();
  };
  return {{"seconds", seconds_},
          {"mean_deg", over(in_degrees(off_rad_s_), seconds_)},
          {"largest_deg", most(largest_off_rad_, seconds_)},
          {"within_share", over(within_s_, seconds_)},
          {"roll_mean_deg", over(in_degrees(roll_rad_s_), rolled_s_)},
          {"roll_largest_deg", most(largest_roll_rad_, rolled_s_)},
          {"in_sight_share", over(in_sight_s_, seconds_)}};
}

}  // namespace omentum::render
