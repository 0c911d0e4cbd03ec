// What an endoscope sees, and how well it is held: known poses, known scores.
#include "render_node/camera_score.h"

#include "geometry/trocar.h"
#include "render_node/camera_exercise.h"
#include "render_node/scope_view.h"
#include "render_node/sight_line.h"
#include "tests/render_node/ball_organ.h"
#include "tests/render_node/recording_renderer.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::render {
namespace {

using test::ball_organ;
using test::scene_with;

constexpr double kScopeRounding = 1e-12, kScopeFloat = 1e-5;
constexpr double kDegree = std::numbers::pi / 180;

// A scope at the origin whose shaft comes from behind and above: it looks along +y and down.
const Vec3 kHandle(0, -1, 0.5);

Camera seen_by(double optics_deg, double roll_rad = 0) {
  const Eigen::Quaterniond q =
      geometry::level_orientation(kHandle) * Eigen::AngleAxisd(roll_rad, Vec3::UnitZ());
  return scope_camera(Vec3::Zero(), q, {.optics_deg = optics_deg});
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(ScopeView, OpticsInclineTheViewDownwardsAndRollWithTheScope) {
  const Vec3 along = -kHandle.normalized();
  for (const double optics : {0.0, 30.0, 45.0}) {
    const Camera level = seen_by(optics), over = seen_by(optics, std::numbers::pi);
    EXPECT_NEAR(angle_between(level.forward(), along), optics * kDegree, kScopeRounding * 1e4);
    EXPECT_NEAR(level.up.dot(level.forward()), 0, kScopeRounding);
    EXPECT_NEAR(level.forward().x(), 0, kScopeRounding) << "neither to the left nor to the right";
    if (optics == 0) continue;
    EXPECT_LT(level.forward().z(), along.z()) << "down";
    EXPECT_GT(over.forward().z(), along.z()) << "half a turn makes it up";
    EXPECT_NEAR(angle_between(level.forward(), over.forward()), 2 * optics * kDegree, 1e-7);
  }
}

TEST(ScopeView, TheLightIsBesideTheLensAndItsShadowMapHoldsTheWholePicture) {
  const Camera camera = seen_by(30);
  const Ball ball{camera.eye + 0.12 * camera.forward(), 0.1};
  const Lighting light = scope_light(camera, ball);
  EXPECT_LT((light.lamp - camera.eye.cast<float>()).norm(), 0.006f);
  EXPECT_NEAR(light.lamp_reach_m, 0.12, 0.001) << "exposed for the middle of what is seen";
  const Vec3 right = camera.forward().cross(camera.up);
  const double rim = std::tan(lens_half_angle(camera));
  for (const double distance : {0.03, 0.1, 0.2}) {
    for (double turn = 0; turn < 6; turn += 0.7) {
      const Vec3 p = camera.eye + distance * (camera.forward() +
                                              rim * (std::cos(turn) * right + std::sin(turn) * camera.up));
      const Eigen::Vector4f clip = light.clip_from_W * p.cast<float>().homogeneous();
      const Vec3f on_map = clip.head<3>() / clip.w();
      EXPECT_LT(on_map.cwiseAbs().maxCoeff(), 1) << distance;
    }
  }
  const auto depth = [&](double distance) {
    const Eigen::Vector4f clip =
        light.clip_from_W * Vec3(camera.eye + distance * camera.forward()).cast<float>().homogeneous();
    return clip.z() / clip.w();
  };
  EXPECT_LT(depth(0.05), depth(0.1)) << "nearer to the lamp shades what is farther";
}

TEST(CameraMoment, AKnownAngleOffTheViewAxisIsThatAngle) {
  const Camera camera = seen_by(30);
  for (const double off_deg : {0.0, 5.0, 20.0, 40.0, 120.0}) {
    const Vec3 way = Eigen::AngleAxisd(off_deg * kDegree, camera.up) * camera.forward();
    const CameraMoment moment = camera_moment(camera, camera.eye + 0.08 * way, false);
    EXPECT_NEAR(moment.off_centre_rad, off_deg * kDegree, 1e-9);
    EXPECT_EQ(moment.in_sight, off_deg < 32) << "the lens' field is 65 degrees wide: " << off_deg;
    EXPECT_FALSE(camera_moment(camera, camera.eye + 0.08 * way, true).in_sight);
  }
}

TEST(CameraMoment, RollIsHowFarThePictureLeansAgainstTheUpright) {
  for (const double roll : {0.0, 0.3, -1.2, 2.0}) {  // about the shaft, which 0 degree optics look along
    const CameraMoment moment = camera_moment(seen_by(0, roll), Vec3(0, 1, 0), false);
    ASSERT_TRUE(moment.roll_rad);
    EXPECT_NEAR(*moment.roll_rad, roll, 1e-9);
  }
  Camera down;
  down.eye = {0, 0, 1};
  down.up = Vec3::UnitY();
  EXPECT_FALSE(camera_moment(down, Vec3::Zero(), false).roll_rad) << "straight down nothing is level";
}

TEST(CameraScore, MomentsCountByHowLongTheyLast) {
  CameraScore score(10);
  score.add(0, {.off_centre_rad = 0, .roll_rad = 0, .in_sight = true});
  score.add(0.2, {.off_centre_rad = 20 * kDegree, .roll_rad = -8 * kDegree, .in_sight = true});
  score.add(0.3, {.off_centre_rad = 5 * kDegree, .roll_rad = {}, .in_sight = false});
  score.skip(0.4);  // the scope is taken out
  score.add(0.6, {.off_centre_rad = 5 * kDegree, .roll_rad = {}, .in_sight = true});  // and comes again
  score.skip(5.6);  // a picture that came late
  const nlohmann::json report = score.report();
  const double seconds = 0.2 + 0.1 + 0.1 + CameraScore::kLongest_s;
  EXPECT_NEAR(report["seconds"], seconds, 1e-9);
  EXPECT_NEAR(report["mean_deg"], (0.1 * 20 + 0.1 * 5 + 0.25 * 5) / seconds, 1e-9);
  EXPECT_NEAR(report["largest_deg"], 20, 1e-9);
  EXPECT_NEAR(report["within_share"], 0.45 / seconds, 1e-9) << "what is hidden is not centred";
  EXPECT_NEAR(report["in_sight_share"], 0.55 / seconds, 1e-9);
  EXPECT_NEAR(report["roll_mean_deg"], 0.1 * 8 / 0.3, 1e-9) << "of the time in which something was level";
  EXPECT_NEAR(report["roll_largest_deg"], 8, 1e-9) << "to either side";
}

TEST(CameraScore, WithoutATimeThatCountsThereIsNoFigure) {
  const nlohmann::json report = CameraScore(10).report();
  EXPECT_EQ(report["seconds"], 0);
  for (const char* key : {"mean_deg", "largest_deg", "within_share", "roll_mean_deg", "in_sight_share"})
    EXPECT_TRUE(report[key].is_null()) << key;
}

TEST(SightLine, WhatStandsBetweenHidesAndWhatIsBehindOrBesideDoesNot) {
  MeshData wall;
  for (const Vec3f& p : {Vec3f(-1, 1, -1), Vec3f(1, 1, -1), Vec3f(0, 1, 1)})
    wall.vertices.push_back({p, Vec3f::UnitY(), p});
  wall.triangles = {{0, 1, 2}};
  const Vec3 eye = Vec3::Zero();
  const Mat4f here = Mat4f::Identity();
  EXPECT_TRUE(hides(wall, here, eye, Vec3(0, 2, 0), 0.01));
  EXPECT_TRUE(hides(wall, here, Vec3(0, 2, 0), eye, 0.01)) << "from either side";
  EXPECT_FALSE(hides(wall, here, eye, Vec3(0, 0.9, 0), 0.01)) << "behind the target";
  EXPECT_FALSE(hides(wall, here, eye, Vec3(0, 1.005, 0), 0.01)) << "the target lies on it";
  EXPECT_FALSE(hides(wall, here, eye, Vec3(3, 2, 0), 0.01)) << "beside it";
  Mat4f aside = Mat4f::Identity();
  aside(0, 3) = 1.5f;
  EXPECT_FALSE(hides(wall, aside, eye, Vec3(0, 2, 0), 0.01));
  EXPECT_TRUE(hides(wall, aside, eye, Vec3(3, 2, 0), 0.01));
}

// A ball, a probe and a scope: the exercise from end to end, but for the clock.
struct Exercise {
  Exercise() {
    scene.tools[1].scope.emplace();
    scene.tools[1].scope->optics_deg = 0;
    scene.organs.emplace_back().name = "ball";
    scene.score.camera.emplace();
  }
  // at `eye`, level, looking at `at`
  static ToolNow scope(const Vec3& eye, const Vec3& at) {
    ToolNow tool;
    tool.seen = true;
    tool.p_WT = eye;
    tool.q_WT = geometry::level_orientation(eye - at);
    return tool;
  }
  nlohmann::json watched(const std::vector<ToolNow>& tools) {
    SceneView view(scene, {shape}, renderer);
    CameraExercise exercise(scene, view);
    for (const double now_s : {0.0, 0.1, 0.2}) exercise.look(now_s, view, tools);
    return exercise.report();
  }
  static constexpr double kRadius = 0.05;
  OrganShape shape = ball_organ(kRadius, 3);
  scene::Scene scene = scene_with({"probe", "endoscope"});
  RecordingRenderer renderer;
};

TEST(CameraExercise, ATipInFrontOfAnOrganIsSeenAndOneBehindItIsNot) {
  Exercise exercise;
  exercise.scene.score.camera->tool = 0;
  const Vec3 eye(0.1, -0.2, 0.05);  // not along the shaft, which would hide its own tip
  for (const bool behind : {false, true}) {
    ToolNow probe = test::tool_at(Vec3(0, behind ? 0.055 : -0.055, 0), Vec3::Zero());
    const nlohmann::json report = exercise.watched({probe, Exercise::scope(eye, probe.p_WT)});
    EXPECT_NEAR(report["seconds"], 0.2, 1e-9);
    EXPECT_NEAR(report["largest_deg"], 0, 1e-4);
    EXPECT_NEAR(report["roll_largest_deg"], 0, 1e-4);
    EXPECT_EQ(report["in_sight_share"], behind ? 0 : 1);
    EXPECT_EQ(report["within_share"], behind ? 0 : 1);
  }
  EXPECT_EQ(exercise.watched({{}, Exercise::scope(eye, Vec3::Zero())})["seconds"], 0) << "no tip, no score";
  EXPECT_EQ(exercise.watched({test::tool_at(eye, Vec3::Zero()), {}})["seconds"], 0) << "nobody holds it";
}

TEST(CameraExercise, APlaceOfAnOrganGoesWithTheTissue) {
  Exercise exercise;
  exercise.scene.score.camera->organ = "ball";
  exercise.scene.score.camera->place = Vec3(0, -Exercise::kRadius, 0);
  SceneView view(exercise.scene, {exercise.shape}, exercise.renderer);
  const CameraTarget target(exercise.scene, view);
  const std::vector<ToolNow> tools(2);
  EXPECT_LT((*target.place(view, tools) - exercise.scene.score.camera->place).norm(), 1e-3);
  std::vector<float> aside;
  for (std::size_t s = 0; s < exercise.shape.rest.size(); ++s) aside.insert(aside.end(), {0.02f, 0, 0});
  view.deform(0, aside);
  EXPECT_NEAR(target.place(view, tools)->x(), 0.02, 1e-3);
}

}  // namespace
}  // namespace omentum::render
