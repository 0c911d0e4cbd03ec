// Drawn jaws are where the hand's points collide.
#include "render_node/jaw_shape.h"

#include "haptic_node/jaws.h"
#include "render_node/instrument_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace omentum::render {
namespace {

using geometry::Vec3;

constexpr double kSeen_m = 5e-4;  // less is not seen: what touches looks as if it touched

// Of a triangle's points the nearest: inside, or on an edge.
double distance_to(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  double nearest = std::numeric_limits<double>::infinity();
  const Vec3 corners[] = {a, b, c};
  bool inside = normal.norm() > 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 from = corners[i], way = corners[(i + 1) % 3] - from;
    const double share = way.isZero(0) ? 0 : std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - from - share * way).norm());
    inside &= normal.cross(way).dot(p - from) >= 0;
  }
  return inside ? std::abs(normal.normalized().dot(p - a)) : nearest;
}

// From p to the triangles of a mesh that face `facing` (any, where that is zero), m.
double distance_to(const Vec3& p, const MeshData& mesh, const Mat4f& pose, const Vec3& facing) {
  double nearest = std::numeric_limits<double>::infinity();
  const Eigen::Matrix4d W_from_mesh = pose.cast<double>();
  for (const MeshTriangle& triangle : mesh.triangles) {
    Vec3 corner[3];
    for (int i = 0; i < 3; ++i)
      corner[i] = (W_from_mesh *
                   mesh.vertices[triangle[static_cast<std::size_t>(i)]].position.cast<double>().homogeneous())
                      .head<3>();
    const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    if (!facing.isZero(0) && normal.dot(facing) <= 0) continue;
    nearest = std::min(nearest, distance_to(p, corner[0], corner[1], corner[2]));
  }
  return nearest;
}

class DrawnJaws : public ::testing::TestWithParam<const char*> {};

TEST_P(DrawnJaws, AreWithinHalfAMillimetreOfTheCollidingPointsAtEveryOpening) {
  const scene::Scene scene =
      scene::load_scene(std::string(OMENTUM_SOURCE_DIR "/scenes/") + GetParam() + ".toml");
  int tested = 0;
  for (const scene::ToolSpec& tool : scene.tools) {
    if (tool.shape != "grasper") continue;
    haptic::ToolModel model;
    model.points = tool.points;
    model.grasps = true;
    const JawForm form = jaw_form(tool);
    for (const InstrumentPart& part : instrument_parts(tool, Vec3f::Ones())) {
      if (part.jaw == 0) continue;
      for (const double grip : {0.0, 0.15, 0.6, 1.2}) {
        const Mat4f pose = part_pose(part, Vec3::Zero(), Eigen::Quaterniond::Identity(), grip);
        const Vec3 inwards = pose.topLeftCorner<3, 3>().cast<double>() * Vec3(-part.jaw, 0, 0);
        for (const Vec3& point : tool.points) {
          if (haptic::jaw_of(model, point) != static_cast<int>(part.jaw)) continue;
          const Vec3 at = haptic::at_opening(model, point, grip);
          EXPECT_LT(distance_to(at, part.mesh, pose, Vec3::Zero()), kSeen_m) << point.transpose();
          // tissue between hollow jaws meets the inside of their walls; flat ones have points of their own
          const bool inner = form.hollow || std::abs(point.x()) < 1.5 * static_cast<double>(form.gap);
          if (inner) {
            EXPECT_LT(distance_to(at, part.mesh, pose, inwards), kSeen_m) << point.transpose();
          }
          ++tested;
        }
      }
    }
  }
  EXPECT_GE(tested, 20) << "two points on one jaw and three on the other, at each opening";
}
INSTANTIATE_TEST_SUITE_P(Scenes, DrawnJaws,
                         ::testing::Values("liver", "hepatectomy", "two_organs", "liver_cut", "liver_dynamic",
                                           "abdomen", "intestine_plane"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(InstrumentShape, AHooksWireIsWhereItsEdgeCutsAndAloneGlowsWhileItDoes) {
  scene::ToolSpec tool;
  tool.shape = "probe";
  tool.edge = {Vec3(0.004, 0, 0.006), Vec3(0.004, 0, -0.008)};
  int glowing = 0;
  for (const InstrumentPart& part : instrument_parts(tool, Vec3f::Ones())) {
    if (part.glow_cutting.isZero(0)) continue;
    ++glowing;
    for (const double share : {0.0, 0.3, 1.0}) {
      const Vec3 at = tool.edge[0] + share * (tool.edge[1] - tool.edge[0]);
      EXPECT_LT(distance_to(at, part.mesh, Mat4f::Identity(), Vec3::Zero()), 7e-4) << "its radius";
    }
  }
  EXPECT_EQ(glowing, 1);
}

TEST(InstrumentShape, AScopesLensLooksAlongItsOpticsAndItsRingIsAlight) {
  scene::ToolSpec tool;
  tool.shape = "endoscope";
  tool.scope.emplace();
  const Vec3f axis(0, -0.5f, -std::sqrt(0.75f));  // 30 degrees down
  int facing = 0, alight = 0;
  for (const InstrumentPart& part : instrument_parts(tool, Vec3f::Ones())) {
    alight += part.material.glow.isZero(0) ? 0 : 1;
    for (const Vertex& v : part.mesh.vertices)
      if (v.position.norm() < 0.002f && v.normal.dot(axis) > 0.999f) ++facing;
  }
  EXPECT_GT(facing, 8);
  EXPECT_EQ(alight, 1);
}

TEST(InstrumentShape, StaysSmallEnoughForASoftwareRasterizer) {
  for (const char* shape : {"probe", "grasper"}) {
    scene::ToolSpec tool;
    tool.shape = shape;
    std::size_t triangles = 0;
    for (const InstrumentPart& part : instrument_parts(tool, Vec3f::Ones()))
      triangles += part.mesh.triangles.size();
    EXPECT_LT(triangles, 9000u) << shape << ": fewer than a small liver";
  }
}

}  // namespace
}  // namespace omentum::render
