#include "render_node/camera.h"

#include "render_node/lighting.h"
#include "render_node/scope_view.h"

#include <gtest/gtest.h>

#include <numbers>

namespace omentum::render {
namespace {

constexpr double kRounding = 1e-12;  // of double, times the handful of operations
constexpr float kFloat = 1e-4f;      // matrices are single precision

const Ball kBall{{0.1, -0.2, 0.05}, 0.09};

Camera fitted(float aspect) {
  return start_camera({}, kBall, {0.3, -1, 0.5}, aspect);
}

// Where a point lands: -1 to 1 across the picture.
Vec3f on_screen(const View& view, const Vec3& p) {
  const Vec3f q = p.cast<float>();
  const Eigen::Vector4f clip = view.clip_from_eye * (view.eye_from_W * q.homogeneous());
  return clip.hnormalized();
}

TEST(Camera, ExplicitPoseIsKept) {
  scene::CameraSpec spec;
  spec.eye = {1, 2, 3};
  spec.target = {0, 0, 1};
  const Camera camera = start_camera(spec, kBall, Vec3::UnitX(), 1);
  EXPECT_EQ(camera.eye, Vec3(1, 2, 3));
  EXPECT_EQ(camera.target, Vec3(0, 0, 1));
}

TEST(Camera, FittedCameraShowsTheWholeBallInTallAndWidePictures) {
  for (const float aspect : {0.5f, 1.0f, 1.6f, 3.0f}) {
    const View view = view_of(fitted(aspect), kBall, aspect, 0);
    for (int k = 0; k < 200; ++k) {
      const double a = 0.7 * k, z = -1 + 2 * (k + 0.5) / 200, r = std::sqrt(1 - z * z);
      const Vec3f s =
          on_screen(view, kBall.centre + kBall.radius * Vec3(r * std::cos(a), r * std::sin(a), z));
      EXPECT_LT(s.cwiseAbs().maxCoeff(), 1) << "aspect " << aspect;
    }
  }
}

TEST(Camera, TargetIsInTheMiddleAndUpIsUp) {
  const Camera camera = fitted(1.6f);
  const View view = view_of(camera, kBall, 1.6f, 0);
  EXPECT_LT(on_screen(view, camera.target).head<2>().norm(), kFloat);
  EXPECT_GT(on_screen(view, camera.target + 0.01 * camera.up).y(), 0);
  const Vec3 right = camera.forward().cross(camera.up);
  EXPECT_GT(on_screen(view, camera.target + 0.01 * right).x(), 0);
}

TEST(Camera, ShiftMovesTheMiddleByThatShareOfTheWidth) {
  const Camera camera = fitted(1.6f);
  const View view = view_of(camera, kBall, 1.6f, 0.15);
  EXPECT_NEAR(on_screen(view, camera.target).x(), 0.3, kFloat);  // the picture is 2 wide
}

TEST(Camera, OrbitKeepsDistanceAndNeverPassesThePole) {
  Camera camera = fitted(1);
  const double distance = camera.distance();
  for (int k = 0; k < 100; ++k) {
    camera = orbited(camera, 0.3, 0.2);
    EXPECT_NEAR(camera.distance(), distance, kRounding);
    EXPECT_LT(camera.forward().dot(-camera.up), 1 - 1e-4);
  }
  for (int k = 0; k < 100; ++k) camera = orbited(camera, 0, -0.2);
  EXPECT_LT(camera.forward().dot(camera.up), 1 - 1e-4);
}

TEST(Camera, OrbitThereAndBackIsIdentity) {
  const Camera camera = fitted(1);
  const Camera back = orbited(orbited(camera, 0.4, 0.1), -0.4, -0.1);
  EXPECT_LT((back.eye - camera.eye).norm(), 1e-9);
}

TEST(Camera, DraggingDownwardsSeesTheSceneFromAbove) {
  // window coordinates grow downwards, and the loop passes them on as they are
  const Camera camera = fitted(1);
  EXPECT_GT(orbited(camera, 0, 0.1).eye.z(), camera.eye.z());
}

TEST(Camera, ZoomStaysWithinItsLimits) {
  Camera camera = fitted(1);
  for (int k = 0; k < 200; ++k) camera = zoomed(camera, 1, 0.02, 1);
  EXPECT_NEAR(camera.distance(), 0.02, kRounding);
  for (int k = 0; k < 200; ++k) camera = zoomed(camera, -1, 0.02, 1);
  EXPECT_NEAR(camera.distance(), 1, kRounding);
}

TEST(Camera, PanMovesTheTargetsPointWithTheMouse) {
  const Camera camera = fitted(1);
  const Camera moved = panned(camera, 0.25, 0.1);
  const View view = view_of(moved, kBall, 1, 0);
  const Vec3f s = on_screen(view, camera.target);
  EXPECT_NEAR(s.x(), 0.5, kFloat);
  EXPECT_NEAR(s.y(), 0.2, kFloat);
}

TEST(Camera, ScopeLooksAlongItsShaftAwayFromTheHandle) {
  const Eigen::Quaterniond q(
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));  // z of T along -y of W
  const Camera camera = scope_camera({0, 0.1, 0}, q, {.optics_deg = 0});
  EXPECT_LT((camera.forward() - Vec3::UnitY()).norm(), kRounding);
  EXPECT_EQ(camera.eye, Vec3(0, 0.1, 0));
}

TEST(Camera, NothingToSeeStillGivesABall) {
  EXPECT_GT(ball_around({}).radius, 0);
}

TEST(Lighting, RakingLightIsFlatOverASurfaceThatIsLookedAtFlatly) {
  Camera flat = fitted(1);
  flat.eye = flat.target + 0.1 * Vec3(0, -0.9, 0.4);
  const double lamp = light_scene(flat, kBall).towards_key.cast<double>().dot(flat.up);
  const double raking = rake_light(flat, kBall).towards_key.cast<double>().dot(flat.up);
  EXPECT_GT(raking, 0.3) << "not from below";
  EXPECT_LT(raking, lamp);
}

TEST(Lighting, ShadowBoxHoldsTheBallAndLooksAlongTheLight) {
  const Lighting light = light_scene(fitted(1), kBall);
  EXPECT_NEAR(light.towards_key.norm(), 1, kFloat);
  const auto clip = [&](const Vec3& p) -> Vec3f {
    return (light.clip_from_W * p.cast<float>().homogeneous()).hnormalized();
  };
  EXPECT_LT(clip(kBall.centre).norm(), kFloat);
  const Vec3 towards = light.towards_key.cast<double>();
  EXPECT_NEAR(clip(kBall.centre + kBall.radius * towards).z(), -1, kFloat);  // nearest to the lamp
  EXPECT_NEAR(clip(kBall.centre - kBall.radius * towards).z(), 1, kFloat);
}

}  // namespace
}  // namespace omentum::render
