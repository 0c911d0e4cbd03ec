// Generated shapes: closed, turned outwards, where instruments say they are.
#include "render_node/solids.h"
#include "render_node/instrument_shape.h"
#include "render_node/shape_pieces.h"
#include "render_node/tissue_pattern.h"

#include "ball_organ.h"
#include "closed_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kSolidFloat = 1e-4f;

// Six times the enclosed volume: positive when all triangles face outwards and the surface is closed.
double volume(const MeshData& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f& p = mesh.vertices[a].position;
    six += p.dot(mesh.vertices[b].position.cross(mesh.vertices[c].position));
  }
  return six / 6;
}

void expect_normals_outward(const MeshData& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f& p = mesh.vertices[a].position;
    const Vec3f area = (mesh.vertices[b].position - p).cross(mesh.vertices[c].position - p);
    for (const auto corner : {a, b, c}) EXPECT_GT(mesh.vertices[corner].normal.dot(area), 0);
  }
}

TEST(Solids, UnitShapesEncloseTheirVolumes) {
  const double pi = std::numbers::pi;
  // polygons of 28 corners lose 0.8 % of a circle's area
  EXPECT_NEAR(volume(unit_shaft()), pi, 0.02 * pi);
  EXPECT_NEAR(volume(unit_head()), pi / 3, 0.02 * pi / 3);
  EXPECT_NEAR(volume(unit_ball()), 4 * pi / 3, 0.03 * 4 * pi / 3);
  for (const MeshData& mesh : {unit_shaft(), unit_head(), unit_ball()}) expect_normals_outward(mesh);
}

TEST(Solids, BallIsSmoothAndAShaftsRimIsAnEdge) {
  for (const Vertex& v : unit_ball().vertices) EXPECT_GT(v.normal.dot(v.position), 0.99f);
  int caps = 0;
  for (const Vertex& v : unit_shaft().vertices) caps += std::abs(v.normal.z()) > 0.99f;
  EXPECT_GT(caps, 0);
  for (const Vertex& v : unit_shaft().vertices) {
    EXPECT_TRUE(std::abs(v.normal.z()) > 0.99f || std::abs(v.normal.z()) < 0.01f) << "a smeared rim";
  }
}

TEST(Solids, GroundIsDarkUnderTheOrganAndOpenFarAway) {
  const OrganShape ball = test::ball_organ(0.05, 3);
  std::vector<Vec3f> normals;
  for (const Vec3& p : ball.rest) normals.push_back(p.normalized().cast<float>());
  const Ball around{Vec3::Zero(), 0.05};
  const MeshData ground = ground_under(ball.rest, normals, around, 4 * std::numbers::pi * 0.05 * 0.05);
  EXPECT_LT(ground.vertices.front().openness, 0.25);  // below the ball's lowest point
  EXPECT_GT(ground.vertices.back().openness, 0.98);
  for (const Vertex& v : ground.vertices) EXPECT_LT(v.position.z(), -0.05);

  // a circle's corners alone
  EXPECT_LT(10 * ground.few.size(), ground.triangles.size());
  float all_m2 = 0, few_m2 = 0;
  for (const MeshTriangle& t : ground.triangles) all_m2 += test::area_of(ground, t).z();
  for (const MeshTriangle& t : ground.few) few_m2 += test::area_of(ground, t).z();
  EXPECT_NEAR(few_m2 / all_m2, 1, 0.02);
}

TEST(Instruments, AreClosedAndTurnedOutwards) {
  for (const char* shape : {"probe", "grasper", "hook", "endoscope"}) {
    scene::ToolSpec tool;
    tool.shape = shape;
    if (tool.shape == "hook") tool.edge = {Vec3(0.003, 0, 0.01), Vec3(0.003, 0, -0.01)};
    if (tool.shape == "endoscope") tool.scope.emplace();
    for (const auto& part : instrument_parts(tool, Vec3f::Ones())) {
      EXPECT_GT(volume(part.mesh), 0) << shape;
      expect_normals_outward(part.mesh);
    }
  }
}

// The most that a part's triangles of the coarsest pictures reach out from the axis in some direction, and
// the least.
std::pair<float, float> coarsest_reach(const InstrumentPart& part) {
  float most = 0, least = 1;
  for (const MeshTriangle& t : part.mesh.few) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3f middle =
          0.5f * (part.mesh.vertices[t[c]].position + part.mesh.vertices[t[(c + 1) % 3]].position);
      least = std::min(least, middle.head<2>().norm());
    }
    for (const std::uint32_t v : t) most = std::max(most, part.mesh.vertices[v].position.head<2>().norm());
  }
  return {most, least};
}

TEST(Instruments, BandsAndMarksLieOnTheirShaftInTheCoarsestPicturesToo) {
  for (const char* shape : {"probe", "endoscope"}) {
    scene::ToolSpec tool;
    tool.shape = shape;
    if (tool.shape == "endoscope") tool.scope.emplace();
    const auto parts = instrument_parts(tool, Vec3f::Ones());
    const float shaft = coarsest_reach(parts.front()).first;
    EXPECT_NEAR(shaft, tool.shaft_radius_m, kSolidFloat);
    for (const InstrumentPart& part : parts) {
      const bool is_mark = tool.shape == "probe" && part.material.colour == kInsulation.colour;
      if (part.material.colour != Vec3f::Ones() && !is_mark) continue;
      EXPECT_FALSE(part.mesh.few.empty());
      EXPECT_GT(coarsest_reach(part).second, shaft) << shape << (is_mark ? " mark" : " band");
      EXPECT_LT(3 * part.mesh.few.size(), part.mesh.triangles.size());
    }
  }
}

TEST(Instruments, ABandBetweenCollarAndShaftStandsOutInTheCoarsestPicturesToo) {
  scene::ToolSpec tool;
  tool.shape = "grasper";
  int bands = 0;
  for (const InstrumentPart& part : instrument_parts(tool, Vec3f::Ones())) {
    if (part.material.colour != Vec3f::Ones()) continue;
    ++bands;
    EXPECT_GT(coarsest_reach(part).second, 1.02 * tool.shaft_radius_m);
  }
  EXPECT_EQ(bands, 1);
}

TEST(Instruments, AProbesMarksAreAsWideAsAPixelOfTheCoarsestPictures) {
  scene::ToolSpec tool;
  tool.shape = "probe";
  for (const InstrumentPart& part : instrument_parts(tool, Vec3f::Ones())) {
    if (part.material.colour != kInsulation.colour) continue;
    for (const MeshTriangle& t : part.mesh.few) {
      const auto [low, high] =
          std::minmax({part.mesh.vertices[t[0]].position.z(), part.mesh.vertices[t[1]].position.z(),
                       part.mesh.vertices[t[2]].position.z()});
      EXPECT_GT(high - low, 0.0015f) << "from border to border: a mark is 0.7 mm wide, a pixel 1.8 mm";
    }
  }
}

TEST(Instruments, ReachFromTheTipAlongZ) {
  for (const char* shape : {"probe", "grasper"}) {
    scene::ToolSpec tool;
    tool.shape = shape;
    float lowest = 1, highest = 0;
    for (const auto& part : instrument_parts(tool, Vec3f::Ones())) {
      for (const Vertex& v : part.mesh.vertices) {
        lowest = std::min(lowest, v.position.z());
        highest = std::max(highest, v.position.z());
        EXPECT_LT(v.position.head<2>().norm(), 1.1 * tool.shaft_radius_m);
      }
    }
    EXPECT_NEAR(lowest, 0, kSolidFloat);
    EXPECT_NEAR(highest, tool.shaft_length_m, kSolidFloat);
  }
}

TEST(Instruments, JawsOpenAlongXByTheGripAngle) {
  scene::ToolSpec tool;
  tool.shape = "grasper";
  const double grip = 0.8;
  std::vector<double> tips;
  for (const auto& part : instrument_parts(tool, Vec3f::Ones())) {
    if (part.jaw == 0) continue;
    const Mat4f pose = part_pose(part, Vec3::Zero(), Eigen::Quaterniond::Identity(), grip);
    const Vec3f tip = (pose * Eigen::Vector4f(0, 0, 0, 1)).head<3>();
    const Vec3f hinge(0, 0, part.hinge_z);
    EXPECT_NEAR((tip - hinge).norm(), part.hinge_z, kSolidFloat);
    EXPECT_GT(part.jaw * tip.x(), 0);
    tips.push_back(std::atan2(tip.x(), part.hinge_z - tip.z()));
  }
  ASSERT_EQ(tips.size(), 2u);
  EXPECT_NEAR(std::abs(tips[0] - tips[1]), grip, kSolidFloat);
}

TEST(Instruments, PoseCarriesThemWhole) {
  InstrumentPart part;
  const Eigen::Quaterniond q(Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()));
  const Mat4f pose = part_pose(part, {0.1, 0.2, 0.3}, q, 0.5);
  EXPECT_LT((pose.topLeftCorner<3, 3>() - q.toRotationMatrix().cast<float>()).norm(), kSolidFloat);
  EXPECT_LT((pose.topRightCorner<3, 1>() - Vec3f(0.1f, 0.2f, 0.3f)).norm(), kSolidFloat);
}

TEST(Instruments, ToolsHaveDistinctColours) {
  for (std::uint32_t a = 0; a < 4; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) EXPECT_GT((tool_colour(a) - tool_colour(b)).norm(), 0.2);
  }
}

TEST(TissuePattern, RepeatsWithoutASeamAndIsAlwaysTheSame) {
  constexpr int kSide = 16;
  const TissuePattern pattern = make_tissue_pattern(kSide);
  ASSERT_EQ(pattern.texels.size(), 4u * kSide * kSide * kSide);
  EXPECT_EQ(pattern.texels, make_tissue_pattern(kSide).texels);
  // a step across the seam is no larger than the largest step inside
  const auto value = [&](int x, int y, int z) {
    return pattern.texels[4 * ((z * kSide + y) * kSide + x) + 3];
  };
  int inside = 0, seam = 0;
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x + 1 < kSide; ++x)
        inside = std::max(inside, std::abs(value(x, y, z) - value(x + 1, y, z)));
      seam = std::max(seam, std::abs(value(kSide - 1, y, z) - value(0, y, z)));
    }
  }
  EXPECT_LE(seam, inside);
  EXPECT_GT(inside, 0);
}

}  // namespace
}  // namespace omentum::render
