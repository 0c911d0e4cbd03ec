// From state to what is drawn, on a renderer that only remembers.
#include "render_node/scene_view.h"

#include "ball_organ.h"
#include "recording_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::render {
namespace {

using test::ball_organ;
using test::scene_with;
using test::tool_at;

constexpr double kRadius = 0.05;
constexpr float kFloat = 1e-5f;
const Vec3 kTop(0, 0, kRadius);

struct Stage {
  explicit Stage(scene::Scene with = scene_with({"probe", "grasper"}))
      : scene(std::move(with)), view(scene, {shape}, renderer) {
    choices.orbit = view.first_camera();
  }
  Frame frame(const std::vector<ToolNow>& tools, double panel_share = 0) {
    return view.frame(choices, tools, panel_share);
  }
  OrganShape shape = ball_organ(kRadius, 3);
  scene::Scene scene;
  RecordingRenderer renderer;
  SceneView view;
  ViewChoices choices;
};

std::vector<DrawItem> with_look(const Frame& frame, Look look) {
  std::vector<DrawItem> items;
  std::copy_if(frame.items.begin(), frame.items.end(), std::back_inserter(items),
               [&](const DrawItem& item) { return item.look == look; });
  return items;
}

// The points of an item in W.
std::vector<Vec3f> points_of(const Stage& stage, const DrawItem& item) {
  std::vector<Vec3f> points;
  for (const Vertex& v : stage.renderer.mesh_of(item).vertices) {
    points.push_back((item.W_from_mesh * v.position.homogeneous()).hnormalized());
  }
  return points;
}

// How far the arrow reaches along and across a direction.
struct Reach {
  float along = -1e9f, back = 1e9f, across = 0;
};
Reach reach(const Stage& stage, const std::vector<DrawItem>& items, const Vec3& from, const Vec3& direction) {
  Reach reach;
  const Vec3f origin = from.cast<float>(), d = direction.normalized().cast<float>();
  for (const DrawItem& item : items) {
    for (const Vec3f& p : points_of(stage, item)) {
      const float along = (p - origin).dot(d);
      reach.along = std::max(reach.along, along);
      reach.back = std::min(reach.back, along);
      reach.across = std::max(reach.across, (p - origin - along * d).norm());
    }
  }
  return reach;
}

TEST(SceneView, OnlyToolsThatWereSeenAreDrawn) {
  Stage stage;
  EXPECT_TRUE(with_look(stage.frame({{}, {}}), Look::kSolid).empty());
  const auto one = with_look(stage.frame({tool_at(kTop, Vec3::Zero()), {}}), Look::kSolid).size();
  const auto two =
      with_look(stage.frame({tool_at(kTop, Vec3::Zero()), tool_at(-kTop, Vec3::Zero())}), Look::kSolid)
          .size();
  EXPECT_GT(one, 0u);
  EXPECT_GT(two, one);
}

TEST(SceneView, OrganFollowsItsState) {
  Stage stage;
  const auto item = with_look(stage.frame({{}, {}}), Look::kTissue).at(0);
  const Vec3f before = stage.renderer.mesh_of(item).vertices[4].position;
  stage.view.deform(0, test::dent(stage.shape, stage.shape.rest[4], 0.008, 0.01));
  const Vec3f after = stage.renderer.mesh_of(item).vertices[4].position;
  EXPECT_LT((after - before - Vec3f(0, 0, -0.008f)).norm(), kFloat);
  EXPECT_EQ(stage.renderer.updates, 1);
}

TEST(SceneView, TheGroundIsThePlaneThatOrgansFallOn) {
  const auto height_in = [](const scene::Scene& scene) {
    Stage stage(scene);
    return stage.renderer.mesh_of(with_look(stage.frame({}), Look::kGround).at(0)).vertices[0].position.z();
  };
  scene::Scene scene = scene_with({});
  EXPECT_NEAR(height_in(scene), -kRadius, 0.1 * kRadius) << "under the ball";
  scene.obstacles = {{.shape = "plane", .centre = Vec3(1, 2, -0.3), .normal = Vec3::UnitX()},
                     {.shape = "plane", .centre = Vec3(1, 2, -0.2)}};
  EXPECT_NEAR(height_in(scene), -0.2, kFloat);
}

// A ball behind another one, as the scene's own camera sees them.
TEST(SceneView, AnOrganIsExposedAsFarAsOthersAndToolsLeaveIt) {
  scene::Scene scene = scene_with({"probe"});
  scene.camera.eye = {0, -1, 0};
  OrganShape front = ball_organ(kRadius, 3), behind = front;
  for (Vec3& p : behind.rest) p.y() += 3 * kRadius;
  RecordingRenderer renderer;
  SceneView view(scene, {front, behind}, renderer);
  ExposureRaster raster({160, 120});
  std::vector<ToolNow> tools(1);
  EXPECT_LT(*view.exposed_share(1, tools, raster), 0.05);
  std::vector<float> aside;
  for (std::size_t s = 0; s < front.rest.size(); ++s) aside.insert(aside.end(), {0.1f, 0, 0});
  view.deform(0, aside);
  EXPECT_EQ(view.exposed_share(1, tools, raster), 1.0);
  tools[0] = tool_at(Vec3(0, -0.2, -kRadius), Vec3::Zero());
  tools[0].q_WT.setIdentity();
  const double beside_shaft = *view.exposed_share(1, tools, raster);
  EXPECT_GT(beside_shaft, 0.5);
  EXPECT_LT(beside_shaft, 0.99) << "the shaft is in front of it";
}

// A second ball beside the first one, with the look of a gallbladder.
TEST(SceneView, TwoOrgansLookMoveAndAreDentedEachByItself) {
  const scene::Scene scene = scene_with({"probe"});
  OrganShape liver = ball_organ(kRadius, 3), sac = liver;
  for (Vec3& p : sac.rest) p.x() += 3 * kRadius;
  sac.material = tissue_material("gallbladder");
  RecordingRenderer renderer;
  SceneView view(scene, {liver, sac}, renderer);
  ViewChoices choices;
  choices.orbit = view.first_camera();
  const auto drawn = with_look(view.frame(choices, std::vector<ToolNow>(1), 0), Look::kTissue);
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_GT(drawn[0].material.colour.x(), drawn[0].material.colour.y()) << "red";
  EXPECT_LT(drawn[1].material.colour.x(), drawn[1].material.colour.y()) << "green";

  const float before = renderer.mesh_of(drawn[0]).vertices[4].position.z();
  view.deform(1, test::dent(liver, liver.rest[4], 0.008, 0.01));
  EXPECT_EQ(renderer.mesh_of(drawn[0]).vertices[4].position.z(), before);
  EXPECT_NEAR(renderer.mesh_of(drawn[1]).vertices[4].position.z(), before - 0.008f, kFloat);

  ToolNow tool = tool_at(kTop, Vec3(0, 0, 1));
  tool.contact_nodes = {4 + test::kFirstFileNode};
  tool.contact_forces_n = {1};
  for (const std::size_t organ : {0, 1}) {
    tool.contact_organ = organ;
    const auto dent = view.dent_of(tool);
    ASSERT_TRUE(dent);
    EXPECT_NEAR(dent->depth_m, organ == 0 ? 0 : 0.008, 1e-3);
    EXPECT_NEAR(dent->bottom.x(), organ == 0 ? 0 : 3 * kRadius, kFloat);
  }
}

TEST(SceneView, ArrowStartsAtTheTipAndPointsWithTheForce) {
  Stage stage;
  for (const Vec3& force : {Vec3(0, 0, 1.5), Vec3(-2, 1, 0.3), Vec3(0, 0, -0.8)}) {
    const auto arrow = with_look(stage.frame({tool_at(kTop, force), {}}), Look::kSignal);
    const Reach r = reach(stage, arrow, kTop, force);
    EXPECT_NEAR(r.along, kArrowMetresPerNewton * force.norm(), kFloat);
    EXPECT_GT(r.back, -kFloat);
    EXPECT_LT(r.across, 0.25 * r.along);
  }
}

TEST(SceneView, ArrowGrowsWithTheForceUpToItsLongest) {
  Stage stage;
  float last = 0;
  for (const double newtons : {0.05, 0.3, 1.0, 4.0}) {
    const Vec3 force(0, 0, newtons);
    const float length =
        reach(stage, with_look(stage.frame({tool_at(kTop, force), {}}), Look::kSignal), kTop, force).along;
    EXPECT_GT(length, last);
    last = length;
  }
  const Vec3 huge(0, 0, 500);
  EXPECT_NEAR(
      reach(stage, with_look(stage.frame({tool_at(kTop, huge), {}}), Look::kSignal), kTop, huge).along,
      kLongestArrow_m, kFloat);
}

TEST(SceneView, NoArrowForNoForceNorWhenSwitchedOff) {
  Stage stage;
  EXPECT_TRUE(with_look(stage.frame({tool_at(kTop, Vec3::Zero()), {}}), Look::kSignal).empty());
  EXPECT_TRUE(with_look(stage.frame({tool_at(kTop, Vec3::Constant(NAN)), {}}), Look::kSignal).empty());
  stage.choices.arrows = false;
  EXPECT_TRUE(with_look(stage.frame({tool_at(kTop, Vec3(0, 0, 1)), {}}), Look::kSignal).empty());
}

TEST(SceneView, MarkersSitOnTheDeformedNodes) {
  Stage stage;
  stage.choices.markers = true;
  stage.view.deform(0, test::dent(stage.shape, stage.shape.rest[4], 0.008, 0.01));
  ToolNow tool = tool_at(kTop, Vec3::Zero());
  tool.contact_nodes = {4 + test::kFirstFileNode, 2 /* not on the surface */, 100000 /* not in the mesh */};
  const auto markers = with_look(stage.frame({tool, {}}), Look::kSignal);
  ASSERT_EQ(markers.size(), 1u);
  const Vec3f centre = markers[0].W_from_mesh.topRightCorner<3, 1>();
  EXPECT_LT((centre - Vec3f(0, 0, kRadius - 0.008f)).norm(), kFloat);
  stage.choices.markers = false;
  EXPECT_TRUE(with_look(stage.frame({tool, {}}), Look::kSignal).empty());
}

TEST(SceneView, ContactOfAnUnknownOrganIsIgnored) {
  Stage stage;
  ToolNow tool = tool_at(kTop, Vec3::Zero());
  tool.contact_organ = 7;
  tool.contact_nodes = {6};
  EXPECT_TRUE(with_look(stage.frame({tool, {}}), Look::kSignal).empty());
}

TEST(SceneView, CameraLooksAtTheSideThatIsPressed) {
  scene::Scene scene = scene_with({"probe"});
  scene.hands.emplace_back();
  scene.hands[0].press_normal = {1, 0, 0};
  const Stage stage(scene);
  const Vec3 towards = -stage.view.first_camera().forward();
  EXPECT_GT(towards.x(), 0.3);
  EXPECT_GT(towards.z(), 0.3) << "never from below";
}

TEST(SceneView, EndoscopeFollowsTheScope) {
  scene::Scene scene = scene_with({"probe", "probe"});
  scene.tools[1].scope.emplace();
  Stage stage(scene);
  stage.choices.endoscope = true;
  const Vec3 at(0, -0.2, 0);
  const Frame frame = stage.frame({{}, tool_at(at, Vec3::Zero())});
  EXPECT_TRUE(frame.through_endoscope);
  EXPECT_TRUE(with_look(frame, Look::kGround).empty()) << "inside of a body no drape is seen";
  EXPECT_LT((frame.view.eye - at.cast<float>()).norm(), kFloat);
  EXPECT_TRUE(with_look(frame, Look::kSolid).empty()) << "the scope does not see itself";
  stage.choices.endoscope = false;
  EXPECT_FALSE(with_look(stage.frame({{}, tool_at(at, Vec3::Zero())}), Look::kSolid).empty())
      << "the orbit camera does";
}

TEST(SceneView, EndoscopeWithoutAScopeLooksFromNearer) {
  Stage stage;
  const Frame orbit = stage.frame({{}, {}});
  stage.choices.endoscope = true;
  const Frame scope = stage.frame({{}, {}});
  EXPECT_LT(scope.view.eye.norm(), orbit.view.eye.norm());
}

// A tool that presses the ball's top into a dent.
ToolNow pressing(Stage& stage, double depth_m) {
  stage.view.deform(0, test::dent(stage.shape, stage.shape.rest[4], depth_m, 0.006));
  ToolNow tool = tool_at(kTop - Vec3(0, 0, depth_m), Vec3(0, 0, 1));
  tool.contact_nodes = {4 + test::kFirstFileNode, 100000 /* not in the mesh */};
  tool.contact_forces_n = {1, 1};
  return tool;
}

TEST(SceneView, DentIsWhatATouchingToolPresses) {
  Stage stage;
  const ToolNow tool = pressing(stage, 0.008);
  const auto dent = stage.view.dent_of(tool);
  ASSERT_TRUE(dent);
  EXPECT_NEAR(dent->depth_m, 0.008, 1e-4);
  EXPECT_LT((dent->bottom - Vec3f(0, 0, kRadius - 0.008f)).norm(), kFloat);
  EXPECT_FALSE(stage.view.dent_of(tool_at(kTop, Vec3::Zero())));
}

TEST(SceneView, CloseUpLooksFlatlyAtTheDentWithoutPanelAndSignals) {
  Stage stage;
  const ToolNow tool = pressing(stage, 0.008);
  const auto dent = stage.view.dent_of(tool);
  const Frame frame = stage.view.close_up(*dent, stage.choices, std::vector<ToolNow>{tool, {}});
  EXPECT_FALSE(frame.with_panel);
  EXPECT_EQ(frame.quality, Quality::kFine);
  EXPECT_TRUE(with_look(frame, Look::kSignal).empty()) << "nothing covers the dent";
  EXPECT_FALSE(with_look(frame, Look::kSolid).empty()) << "the tool is in the picture";
  const Vec3f sight = frame.view.eye - dent->bottom;
  const float elevation_deg = std::asin(sight.normalized().z()) * 180 / 3.14159f;
  EXPECT_GT(elevation_deg, 15);
  EXPECT_LT(elevation_deg, 30);
  EXPECT_GT(sight.norm(), 0.07);
  EXPECT_LT(sight.norm(), 0.12);
}

TEST(SceneView, CloseUpAvoidsAShaftThatLeansTowardsTheViewer) {
  Stage stage;
  ToolNow tool = pressing(stage, 0.008);
  const Vec3 familiar = stage.view.first_camera().eye;
  const Vec3 lean = (Vec3(familiar.x(), familiar.y(), 0).normalized() + Vec3::UnitZ()).normalized();
  tool.q_WT = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), lean);
  const auto dent = stage.view.dent_of(tool);
  const Frame frame = stage.view.close_up(*dent, stage.choices, std::vector<ToolNow>{tool, {}});
  const Vec3 sight = (frame.view.eye - dent->bottom).cast<double>().normalized();
  EXPECT_LT(sight.dot(lean), std::cos(0.5)) << "not along the shaft";
}

TEST(SceneView, PanelShiftsTheMiddle) {
  Stage stage;
  EXPECT_FLOAT_EQ(stage.frame({{}, {}}, 0.3).middle, 0.65f);
}

}  // namespace
}  // namespace omentum::render
