#include "render_node/lighting.h"

namespace omentum::render {
namespace {

// A direction towards the light: shares of the direction from the target to the eye, to the left, and
// upwards.
struct Direction {
  double towards_eye, left, up;
};
// about 45 degrees off the line of sight, where relief is shown best and shadows stay in the picture
constexpr Direction kLamp{0.42, 0.62, 0.72};
// about 25 degrees above a surface that is looked at flatly
constexpr Direction kRaking{0.10, 0.90, 0.46};

Lighting light_from(const Direction& from, const Camera& camera, const Ball& ball) {
  const Vec3 back = -camera.forward();
  const Vec3 left = back.cross(camera.up).normalized();
  const Vec3 towards =
      (from.towards_eye * back + from.left * left + from.up * camera.up.normalized()).normalized();

  // an orthographic box around the ball, seen from the light
  const Vec3 x = towards.unitOrthogonal();
  const Vec3 y = towards.cross(x);
  Eigen::Matrix4d clip_from_W = Eigen::Matrix4d::Identity();
  clip_from_W.row(0).head<3>() = x / ball.radius;
  clip_from_W.row(1).head<3>() = y / ball.radius;
  clip_from_W.row(2).head<3>() = -towards / ball.radius;
  clip_from_W.topRightCorner<3, 1>() = -clip_from_W.topLeftCorner<3, 3>() * ball.centre;
  return {towards.cast<float>(), clip_from_W.cast<float>(), static_cast<float>(ball.radius)};
}

}  // namespace

Lighting light_scene(const Camera& camera, const Ball& ball) {
  return light_from(kLamp, camera, ball);
}

Lighting rake_light(const Camera& camera, const Ball& ball) {
  return light_from(kRaking, camera, ball);
}

}  // namespace omentum::render
