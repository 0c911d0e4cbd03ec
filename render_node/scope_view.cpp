#include "render_node/scope_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr double kLookAhead_m = 0.1;
constexpr double kLensRadius = 1.06;  // of half the picture's height, as in lens.frag

// Fibres and lens share a tube of 10 mm: the middle of the light is so far above the lens, m.
constexpr double kLampAbove_m = 0.0045;
// The shadow map reaches so much beyond the lens' field: its shadows fade out from three quarters on
// (common.glsl), and the lamp is beside the lens.
constexpr double kMapReach = 1 / 0.74;
constexpr double kLampNear_m = 0.006;  // what is nearer shades all the same, depths are clamped
constexpr double kLampFar = 3;         // of the distance to the far side of what is seen

// The camera exposes for a middle distance within these, in radii of what is seen: from further away the
// picture gets darker, from nearer brighter, as it does where the light is at its limit.
constexpr double kNearestExposed = 0.35, kFarthestExposed = 2.5;

}  // namespace

Camera scope_camera(const Vec3& p_WT, const Eigen::Quaterniond& q_WT, const scene::ScopeSpec& scope) {
  const double incline = scope.optics_deg * std::numbers::pi / 180;
  const Vec3 forward = q_WT * Vec3(0, -std::sin(incline), -std::cos(incline));
  const Vec3 up = q_WT * Vec3(0, std::cos(incline), -std::sin(incline));
  return {p_WT, p_WT + kLookAhead_m * forward, up, scope.field_of_view_deg};
}

std::optional<std::size_t> scope_of(const scene::Scene& scene) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (scene.tools[t].scope) return t;
  }
  return std::nullopt;
}

double lens_half_angle(const Camera& camera) {
  return std::atan(kLensRadius * std::tan(camera.field_of_view_deg * std::numbers::pi / 360));
}

Lighting scope_light(const Camera& camera, const Ball& ball) {
  const Vec3 forward = camera.forward();
  const Vec3 right = forward.cross(camera.up).normalized(), up = right.cross(forward);
  const Vec3 lamp = camera.eye + kLampAbove_m * up;
  const double distance = (ball.centre - lamp).norm();
  const double near = kLampNear_m, far = kLampFar * (distance + ball.radius);
  const double cot = 1 / (kMapReach * std::tan(lens_half_angle(camera)));
  Eigen::Matrix4d lamp_from_W = Eigen::Matrix4d::Identity();
  lamp_from_W.row(0).head<3>() = right;
  lamp_from_W.row(1).head<3>() = up;
  lamp_from_W.row(2).head<3>() = -forward;
  lamp_from_W.topRightCorner<3, 1>() = -lamp_from_W.topLeftCorner<3, 3>() * lamp;
  Eigen::Matrix4d clip_from_lamp = Eigen::Matrix4d::Zero();
  clip_from_lamp(0, 0) = clip_from_lamp(1, 1) = cot;
  clip_from_lamp(2, 2) = (far + near) / (near - far);
  clip_from_lamp(2, 3) = 2 * far * near / (near - far);
  clip_from_lamp(3, 2) = -1;

  Lighting light;
  light.towards_key = (-forward).cast<float>();
  light.clip_from_W = (clip_from_lamp * lamp_from_W).cast<float>();
  light.radius_m = static_cast<float>(ball.radius);
  light.lamp = lamp.cast<float>();
  light.lamp_reach_m =
      static_cast<float>(std::clamp(distance, kNearestExposed * ball.radius, kFarthestExposed * ball.radius));
  return light;
}

}  // namespace omentum::render
