#include "render_node/pointer_rays.h"

#include "ball_organ.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr double kRayExact = 1e-5;  // views are of single precision
constexpr std::int64_t kAskedAt_ns = 5'000;

Vec3 vector(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}

View some_view(double shift = 0) {
  const Camera camera{{0.3, -0.4, 0.35}, {0.02, 0.01, 0}, {0, 0, 1}, 40};
  return view_of(camera, {{0, 0, 0}, 0.1}, 1.6f, shift);
}

std::vector<ToolNow> seen(std::size_t count) {
  return std::vector<ToolNow>(count, ToolNow{.seen = true});
}

Pointer pointing() {
  return {.inside = true, .x = 0.6f, .y = 0.4f};
}

PointerRays rays_of(const std::vector<std::string>& names) {
  scene::Scene scene;
  for (const std::string& name : names) {
    scene::ToolSpec& tool = scene.tools.emplace_back();
    tool.id = static_cast<std::uint32_t>(10 + scene.tools.size());
    tool.name = name;
    if (name == "endoscope") tool.scope.emplace();
  }
  PointerRays rays(scene);
  rays.drive(true);
  return rays;
}

TEST(PointerRays, ARayGoesThroughWhatIsDrawnUnderThePointer) {
  for (const double shift : {0.0, 0.12}) {
    const View view = some_view(shift);
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0.05, -0.02, 0.04), Vec3(-0.06, 0.03, -0.05)}) {
      const Eigen::Vector4f clip = view.clip_from_eye * view.eye_from_W * place.cast<float>().homogeneous();
      msg::PointerRay ray;
      aim_ray(view, 0.5f * (clip.x() / clip.w() + 1), 0.5f * (1 - clip.y() / clip.w()), ray);
      const Vec3 there = (place - vector(ray.origin)).normalized();
      EXPECT_LT((vector(ray.direction) - there).norm(), kRayExact);
      EXPECT_NEAR(vector(ray.right).dot(vector(ray.up)), 0, kRayExact);
      EXPECT_GT(vector(ray.up).cross(vector(ray.right)).dot(there), 0.5) << "forward";
    }
  }
}

TEST(PointerRays, WithoutAListenerTheMouseIsTheCameras) {
  PointerRays rays = rays_of({"probe"});
  rays.drive(false);
  EXPECT_TRUE(rays.rays(pointing(), some_view(), seen(1), kAskedAt_ns).empty());
  const Input input{.orbit_x = 3, .pan_y = 4, .zoom = 1};
  const Input left = rays.for_camera(input);
  EXPECT_EQ(left.orbit_x, 3);
  EXPECT_EQ(left.pan_y, 4);
  EXPECT_EQ(left.zoom, 1);
  EXPECT_EQ(rays.help(), "");
}

TEST(PointerRays, EachRaySaysWhatIsHeldDown) {
  PointerRays rays = rays_of({"probe"});
  Pointer pointer = pointing();
  pointer.buttons = msg::POINTER_RIGHT;
  pointer.keys = msg::POINTER_KEY_CUT;
  pointer.wheel = 2;
  const msg::PointerRay first = rays.rays(pointer, some_view(), seen(1), kAskedAt_ns).front();
  EXPECT_EQ(first.tool, 11U);
  EXPECT_EQ(first.seq, 1U);
  EXPECT_EQ(first.stamp_ns, kAskedAt_ns);
  EXPECT_TRUE(first.valid);
  EXPECT_EQ(first.buttons, msg::POINTER_RIGHT);
  EXPECT_EQ(first.keys, msg::POINTER_KEY_CUT);
  const msg::PointerRay second = rays.rays(pointer, some_view(), seen(1), kAskedAt_ns).front();
  EXPECT_EQ(second.seq, 2U);
  EXPECT_EQ(second.wheel, 4) << "a level";
}

TEST(PointerRays, ThePanelAndTheCameraTakeThePointerFromTheTool) {
  PointerRays rays = rays_of({"probe"});
  Pointer panel = pointing(), middle = pointing(), key = pointing();
  panel.inside = false;
  middle.buttons = msg::POINTER_MIDDLE;
  key.camera_key = true;
  for (Pointer pointer : {panel, middle, key}) {
    pointer.wheel = 5;
    const msg::PointerRay ray = rays.rays(pointer, some_view(), seen(1), kAskedAt_ns).front();
    EXPECT_FALSE(ray.valid);
    EXPECT_EQ(ray.wheel, 0);
  }
}

TEST(PointerRays, TheCameraIsTurnedByTheMiddleButtonOrItsKeyAlone) {
  const PointerRays rays = rays_of({"probe"});
  Input input{.orbit_x = 7, .zoom = 1, .keys = KeyPresses('S')};
  input.pointer = pointing();
  input.pointer.dx = 7;
  input.pointer.wheel = 1;
  input.pointer.buttons = msg::POINTER_LEFT;
  EXPECT_EQ(rays.for_camera(input).orbit_x, 0);
  EXPECT_EQ(rays.for_camera(input).zoom, 0);
  EXPECT_TRUE(rays.for_camera(input).keys.has('S'));
  input.pointer.camera_key = true;
  EXPECT_EQ(rays.for_camera(input).orbit_x, 7);
  EXPECT_EQ(rays.for_camera(input).zoom, 1);
  input.pointer.buttons = msg::POINTER_RIGHT;
  EXPECT_EQ(rays.for_camera(input).orbit_x, 0);
  EXPECT_EQ(rays.for_camera(input).pan_x, 7);
  input.pointer.buttons = msg::POINTER_MIDDLE;
  input.pointer.camera_key = false;
  EXPECT_EQ(rays.for_camera(input).orbit_x, 7);
  input.pointer.inside = false;
  EXPECT_EQ(rays.for_camera(input).orbit_x, 0);
}

TEST(PointerRays, TheNextToolIsOneThatIsThereAndTheOneBeforeIsLetGo) {
  PointerRays rays = rays_of({"probe", "endoscope", "absent", "grasper"});
  std::vector<ToolNow> tools = seen(4);
  tools[2].seen = false;
  Pointer pointer = pointing();
  pointer.wheel = 3;
  EXPECT_EQ(rays.rays(pointer, some_view(), tools, kAskedAt_ns).size(), 1U);
  pointer.next_tool = true;
  const auto both = rays.rays(pointer, some_view(), tools, kAskedAt_ns);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].tool, 11U);
  EXPECT_FALSE(both[0].valid);
  EXPECT_EQ(both[0].wheel, 3);
  EXPECT_EQ(both[1].tool, 14U);
  EXPECT_TRUE(both[1].valid);
  EXPECT_EQ(both[1].wheel, 3) << "its own level, of this frame";
  EXPECT_EQ(rays.tool(), 3U);
  EXPECT_NE(rays.help().find("grasper"), std::string::npos);
  tools[0].seen = false;
  EXPECT_EQ(rays.rays(pointer, some_view(), tools, kAskedAt_ns).size(), 1U) << "there is no other";
  EXPECT_EQ(rays.tool(), 3U);
}

}  // namespace
}  // namespace omentum::render
