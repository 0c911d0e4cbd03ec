#include "render_node/tube_cylinder.h"

#include "closed_mesh.h"
#include "gut_organ.h"
#include "render_node/tube_compare/tube_trial.h"
#include "render_node/tube_frames.h"

#include <gtest/gtest.h>

#include <numbers>

namespace omentum::render {
namespace {

constexpr float kWall_m = 0.02f;

/// A frame in the plane x y whose axis has turned by that angle.
SkinFrame frame_at(const Vec3f& origin, float angle, float half_m) {
  SkinFrame frame;
  frame.origin = origin;
  frame.t = {std::cos(angle), std::sin(angle), 0};
  frame.k = {-std::sin(angle), std::cos(angle), 0};
  frame.ahead = frame.behind = half_m;
  frame.walls.fill(pack_wall(1, 0));
  return frame;
}

/// Frames of a circle that are `turn` apart, in arcs of `way_m`.
std::vector<SkinFrame> arc(float turn, float way_m, int pieces) {
  std::vector<SkinFrame> frames;
  const float radius = way_m / turn;
  for (int j = 0; j <= pieces; ++j) {
    const float angle = turn * static_cast<float>(j);
    frames.push_back(
        frame_at({radius * std::sin(angle), radius * (1 - std::cos(angle)), 0}, angle, way_m / 2));
    frames.back().bend_k = kWall_m / radius;
    frames.back().along = way_m * static_cast<float>(j);
  }
  return frames;
}

/// Vertices in the very same place become one.
MeshData welded(const MeshData& mesh) {
  MeshData one;
  std::map<std::array<float, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> place;
  for (const Vertex& v : mesh.vertices) {
    const std::array<float, 3> p{v.position.x(), v.position.y(), v.position.z()};
    const auto [at, is_new] = known.try_emplace(p, static_cast<std::uint32_t>(one.vertices.size()));
    if (is_new) one.vertices.push_back(v);
    place.push_back(at->second);
  }
  for (const auto& [a, b, c] : mesh.triangles) one.triangles.push_back({place[a], place[b], place[c]});
  return one;
}

std::vector<geometry::Vec3> meandering() {
  const geometry::GutShape gut = test::gut_shape();
  return {gut.positions.begin(), gut.positions.begin() + gut.layout.columns};
}

TEST(SkinWeight, FallsSmoothlyFromOneToNothing) {
  EXPECT_EQ(skin_weight(0), 1);
  EXPECT_EQ(skin_weight(1), 0);
  EXPECT_EQ(skin_weight_slope(0), 0);
  EXPECT_EQ(skin_weight_slope(1), 0);
  constexpr float kStepOfZ = 1e-3f;
  for (float z = kStepOfZ; z < 1 - kStepOfZ; z += 0.01f) {
    const float difference = (skin_weight(z + kStepOfZ) - skin_weight(z - kStepOfZ)) / (2 * kStepOfZ);
    EXPECT_NEAR(skin_weight_slope(z), difference, 1e-2f) << z;
    EXPECT_LT(difference, 0) << z;
  }
}

TEST(TubeCylinder, HasTwoToTheNextPowerOfSectionsAndIsClosed) {
  for (int n = 0; n <= 3; ++n) {
    const std::vector<SkinFrame> frames = arc(0.3f, 0.03f, 4);
    const TubeCylinder cylinder = make_tube_cylinder(n);
    const MeshData mesh = skinned_tube(frames, kWall_m, cylinder);
    EXPECT_TRUE(test::is_closed(welded(mesh))) << n;
    EXPECT_EQ(test::flipped_triangles(mesh), 0) << n;
    const auto around = static_cast<std::size_t>(TubeCylinder::kAround);
    EXPECT_EQ(cylinder.wall_triangles, 2 * around * ((std::size_t{2} << n) - 1));
    const std::size_t caps = cylinder.vertices.size() - around * (std::size_t{2} << n);
    EXPECT_EQ(mesh.vertices.size(), 4 * cylinder.wall_vertices + caps);
    EXPECT_EQ(tube_cost(frames.size(), n), (TubeCost{4, mesh.vertices.size()}));
  }
}

TEST(TubeCylinder, IsClosedWithFewVerticesAroundToo) {
  const TubeCylinder cylinder = make_tube_cylinder(0, TubeCylinder::kFewAround);
  EXPECT_EQ(cylinder.wall_vertices, 2 * std::size_t{TubeCylinder::kFewAround});
  const MeshData mesh = skinned_tube(arc(0.3f, 0.03f, 4), kWall_m, cylinder);
  EXPECT_TRUE(test::is_closed(welded(mesh)));
  EXPECT_EQ(test::flipped_triangles(mesh), 0);
}

TEST(SkinFrame, OpennessAndPallorShareANumber) {
  for (const float openness : {0.0f, 0.32f, 0.5f, 0.999f, 1.0f}) {
    for (const float pallor : {0.0f, 0.01f, 0.5f, 0.99f, 1.0f}) {
      const float wall = pack_wall(openness, pallor);
      EXPECT_NEAR(openness_of(wall), openness, 0.5f / kWallSteps + 1e-6f);
      EXPECT_NEAR(pallor_of(wall), pallor, 1e-4f);
    }
  }
}

TEST(SkinnedWall, NeighboursShareTheirSectionsPlacesAndNormals) {
  TubeFrames tube(meandering(), kWall_m);  // loops as tight as that give way
  const std::span<const SkinFrame> frames = tube.frames();
  ASSERT_GT(frames.size(), 100u);
  for (const CylinderVertex& corner : make_tube_cylinder(0).vertices) {
    if (corner.forward != 0) continue;
    CylinderVertex first = corner, last = corner;
    first.z = 0;
    last.z = 1;
    for (std::size_t j = 1; j + 1 < frames.size(); ++j) {
      const Vertex before = skinned(frames[j - 1], frames[j], kWall_m, last);
      const Vertex behind = skinned(frames[j], frames[j + 1], kWall_m, first);
      ASSERT_EQ(before.position, behind.position);
      ASSERT_EQ(before.rest, behind.rest);
      ASSERT_EQ(before.openness, behind.openness);
      ASSERT_LT((before.normal - behind.normal).norm(), 1e-5f);
    }
  }
}

TEST(SkinnedWall, NormalsAreTheSurfacesOwn) {
  constexpr float kTurn = 0.02f;  // rad, and as much of z
  const std::vector<SkinFrame> frames = arc(0.5f, 0.02f, 1);
  for (float z = 0.1f; z < 0.95f; z += 0.2f) {
    for (float angle = 0.1f; angle < 6.2f; angle += 0.3f) {
      const auto at = [&](float a, float along) {
        const CylinderVertex corner{std::cos(a), std::sin(a), along, 0, 1, 0};
        return skinned(frames[0], frames[1], kWall_m, corner);
      };
      const Vec3f around = at(angle + kTurn, z).position - at(angle - kTurn, z).position;
      const Vec3f along = at(angle, z + kTurn).position - at(angle, z - kTurn).position;
      EXPECT_GT(at(angle, z).normal.dot(around.cross(along).normalized()), 0.999f) << z << ' ' << angle;
    }
  }
}

TEST(SkinnedWall, OfACircleIsATorus) {
  constexpr float kWay_m = 0.04f, kTurnOfPiece = 0.6f;  // a loop as tight as bowel makes it
  const float circle = kWay_m / kTurnOfPiece;
  const MeshData mesh = skinned_tube(arc(kTurnOfPiece, kWay_m, 6), kWall_m, make_tube_cylinder(2));
  for (const Vertex& v : mesh.vertices) {
    if (v.rest.x() < 0 || v.rest.x() > 6 * kWay_m) continue;  // a cap
    const Vec3f from_middle = v.position - Vec3f(0, circle, 0);
    const float off = std::hypot(std::hypot(from_middle.x(), from_middle.y()) - circle, v.position.z());
    EXPECT_NEAR(off, kWall_m, 0.06f * kWall_m);  // on the inner side: 1 - cos 0.3, and what the axis is off
  }
}

TEST(SkinnedWall, ThePatternOfAStraightTubeLiesEvenly) {
  std::vector<SkinFrame> frames;
  for (const float x : {0.0f, 0.03f, 0.035f, 0.08f}) {
    frames.push_back(frame_at({x, 0, 0}, 0, 0));
    frames.back().along = x;
  }
  for (std::size_t j = 0; j + 1 < frames.size(); ++j)
    frames[j].ahead = frames[j + 1].behind = (frames[j + 1].along - frames[j].along) / 2;
  for (const Vertex& v : skinned_tube(frames, kWall_m, make_tube_cylinder(3)).vertices)
    EXPECT_LT((v.rest - v.position).norm(), 1e-6f);
}

TEST(SkinnedWall, IsNeverInsideOutHoweverSharplyItFolds) {
  for (const double folded : {0.3, 0.6, 0.8, 1.0}) {
    trial::BruteSweep brute(40, 8);
    brute.deform(trial::folding_axis(40, folded));
    TubeFrames tube(trial::folding_axis(40, folded), trial::kRadius_m);
    for (const TubeResolution& resolution : kTubeLadder) {
      tube.set_eps(resolution.eps);
      const MeshData mesh = skinned_tube(tube.frames(), tube.radius_m(), make_tube_cylinder(resolution.n));
      // of two sections, a sliver in a kink may face away from one corner's normal
      EXPECT_LE(test::flipped_triangles(mesh), resolution.n == 0 ? 1 : 0)
          << folded << ' ' << resolution.eps << ' ' << resolution.n;
    }
    if (folded > 0.5) {
      EXPECT_GT(trial::turned_inside_out(brute.mesh()), 0u) << "the sweep without care";
    }
  }
}

TEST(GiveWay, LeavesAModerateBendAloneAndNeverReachesACrossing) {
  EXPECT_EQ(give_way(-3), 1);
  EXPECT_EQ(give_way(0.5f), 1);
  for (float bend = 0; bend < 50; bend += 0.01f) EXPECT_LT(bend * give_way(bend), 0.701f);
}

}  // namespace
}  // namespace omentum::render
