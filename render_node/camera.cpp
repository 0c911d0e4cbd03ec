#include "render_node/camera.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr double kFitMargin = 1.12;         // of the ball's radius, so that nothing touches the frame
constexpr double kPoleDistance_rad = 0.05;  // looking straight along `up` would leave the roll undefined
constexpr double kZoomPerStep = 0.9;        // of the distance, per step of the wheel
constexpr double kNearest = 0.02;  // near plane, of the distance to the target: below it depth bits run out
constexpr double kFarRadii = 14;   // far plane behind the ball: the ground must have faded out before

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

Mat4f look_at(const Camera& camera) {
  const Vec3 forward = camera.forward();
  const Vec3 right = forward.cross(camera.up).normalized();
  const Vec3 up = right.cross(forward);
  Eigen::Matrix4d eye_from_W = Eigen::Matrix4d::Identity();
  eye_from_W.row(0).head<3>() = right;
  eye_from_W.row(1).head<3>() = up;
  eye_from_W.row(2).head<3>() = -forward;
  eye_from_W.topRightCorner<3, 1>() = -eye_from_W.topLeftCorner<3, 3>() * camera.eye;
  return eye_from_W.cast<float>();
}

Mat4f perspective(double field_of_view_deg, float aspect, double near, double far, double shift) {
  const double cot = 1 / std::tan(radians(field_of_view_deg) / 2);
  Eigen::Matrix4d clip_from_eye = Eigen::Matrix4d::Zero();
  clip_from_eye(0, 0) = cot / aspect;
  clip_from_eye(0, 2) = -2 * shift;  // clip x runs from -1 to 1, and w is -z
  clip_from_eye(1, 1) = cot;
  clip_from_eye(2, 2) = (far + near) / (near - far);
  clip_from_eye(2, 3) = 2 * far * near / (near - far);
  clip_from_eye(3, 2) = -1;
  return clip_from_eye.cast<float>();
}

}  // namespace

Ball ball_around(std::span<const Vec3> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  if (box.isEmpty()) return {};
  Ball ball{box.center(), 0};
  for (const Vec3& p : points) ball.radius = std::max(ball.radius, (p - ball.centre).norm());
  return ball;
}

Camera start_camera(const scene::CameraSpec& spec, const Ball& ball, const Vec3& from, float aspect) {
  Camera camera{spec.eye, spec.target, spec.up, spec.field_of_view_deg};
  if (camera.eye != Vec3::Zero() || camera.target != Vec3::Zero()) return camera;
  // the narrower of the two half angles must hold the ball
  const double vertical = radians(camera.field_of_view_deg) / 2;
  const double horizontal = std::atan(std::tan(vertical) * aspect);
  const double distance = kFitMargin * ball.radius / std::sin(std::min(vertical, horizontal));
  camera.target = ball.centre;
  camera.eye = ball.centre + distance * from.normalized();
  return camera;
}

Camera orbited(const Camera& camera, double yaw_rad, double pitch_rad) {
  const Vec3 up = camera.up.normalized();
  Vec3 arm = Eigen::AngleAxisd(yaw_rad, up) * (camera.eye - camera.target);
  const double from_pole = std::acos(std::clamp(arm.normalized().dot(up), -1.0, 1.0));
  const double allowed =
      std::clamp(from_pole - pitch_rad, kPoleDistance_rad, std::numbers::pi - kPoleDistance_rad);
  const Vec3 axis = arm.cross(up);
  if (axis.norm() > 0) arm = Eigen::AngleAxisd(from_pole - allowed, axis.normalized()) * arm;
  Camera turned = camera;
  turned.eye = camera.target + arm;
  return turned;
}

Camera zoomed(const Camera& camera, double steps, double min_m, double max_m) {
  const double distance = std::clamp(camera.distance() * std::pow(kZoomPerStep, steps), min_m, max_m);
  Camera moved = camera;
  moved.eye = camera.target - distance * camera.forward();
  return moved;
}

Camera panned(const Camera& camera, double right, double up) {
  const double height_m = 2 * camera.distance() * std::tan(radians(camera.field_of_view_deg) / 2);
  const Vec3 right_axis = camera.forward().cross(camera.up).normalized();
  const Vec3 up_axis = right_axis.cross(camera.forward());
  const Vec3 step = -height_m * (right * right_axis + up * up_axis);
  Camera moved = camera;
  moved.eye += step;
  moved.target += step;
  return moved;
}

View view_of(const Camera& camera, const Ball& ball, float aspect, double shift) {
  const double near = kNearest * camera.distance();
  const double far = (camera.eye - ball.centre).norm() + kFarRadii * ball.radius;
  return {look_at(camera), perspective(camera.field_of_view_deg, aspect, near, far, shift),
          camera.eye.cast<float>()};
}

}  // namespace omentum::render
