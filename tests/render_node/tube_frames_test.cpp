#include "render_node/tube_frames.h"

#include "gut_organ.h"
#include "render_node/surface_shading.h"
#include "render_node/tube_compare/tube_trial.h"
#include "render_node/tube_cylinder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace omentum::render {
namespace {

constexpr double kGut_m = 0.012;

std::vector<geometry::Vec3> loops() {
  const geometry::GutShape gut = test::gut_shape();
  return {gut.positions.begin(), gut.positions.begin() + gut.layout.columns};
}

std::vector<geometry::Vec3> rod(int masses, double length_m) {
  std::vector<geometry::Vec3> axis;
  for (int i = 0; i < masses; ++i) axis.emplace_back(length_m * i / (masses - 1), 0, 0);
  return axis;
}

TEST(TubeFrames, AreOfUnitDirectionsAtRightAnglesAlongTheGut) {
  const TubeFrames tube(loops(), kGut_m);
  float before = -1;
  for (const SkinFrame& frame : tube.frames()) {
    EXPECT_NEAR(frame.t.norm(), 1, 1e-5f);
    EXPECT_NEAR(frame.k.norm(), 1, 1e-5f);
    EXPECT_NEAR(frame.t.dot(frame.k), 0, 1e-5f);
    EXPECT_GT(frame.along, before);
    before = frame.along;
  }
  EXPECT_EQ(tube.frames().front().along, 0);
  EXPECT_NEAR(before, tube.rest_length_m(), 1e-6);
  EXPECT_NEAR(tube.length_m(), 1.6, 0.01);
}

TEST(TubeFrames, NothingTurnsOnTheWallWhenAPieceIsCut) {
  TubeFrames tube(trial::folding_axis(60, 0.4), trial::kRadius_m);
  tube.set_eps(kCoarsestTubeEps);
  const std::vector<SkinFrame> coarse(tube.frames().begin(), tube.frames().end());
  tube.set_eps(kFinestTubeEps);
  ASSERT_GT(tube.frames().size(), coarse.size());
  int met = 0;
  for (const SkinFrame& frame : tube.frames()) {
    for (const SkinFrame& other : coarse) {
      if (other.along != frame.along) continue;
      EXPECT_EQ(frame.k, other.k);
      EXPECT_EQ(frame.origin, other.origin);
      ++met;
    }
  }
  EXPECT_GT(met, 20);
}

TEST(TubeFrames, ThePatternStaysInPlaceWhileALoopElsewhereIsPulled) {
  TubeFrames tube(rod(21, 0.4), kGut_m);
  std::vector<geometry::Vec3> pulled = rod(21, 0.4);
  pulled[10].z() += 0.06;
  tube.deform(pulled);
  const MeshData mesh = skinned_tube(tube.frames(), tube.radius_m(), make_tube_cylinder(2));
  int met = 0;
  for (const Vertex& v : mesh.vertices) {
    if (v.position.x() > 0.14f) continue;  // mass 7 and what is before it did not move
    EXPECT_NEAR(v.rest.x(), v.position.x(), 0.001f);
    ++met;
  }
  EXPECT_GT(met, 500);
}

TEST(TubeFrames, SharesOfTheMapLieAlongIt) {
  TubeFrames tube(rod(21, 0.4), kGut_m);
  std::vector<float> shares(21);
  for (std::size_t m = 0; m < shares.size(); ++m) shares[m] = static_cast<float>(m) / 20;
  tube.map(shares);
  tube.deform(rod(21, 0.4));
  for (const Vertex& v : skinned_tube(tube.frames(), tube.radius_m(), make_tube_cylinder(2)).vertices)
    EXPECT_NEAR(v.share, std::clamp(v.position.x() / 0.4f, 0.0f, 1.0f), 1e-3f);
}

TEST(TubeFrames, TellHowMuchAPieceIsFolded) {
  TubeFrames tube(trial::folding_axis(20, 0.5), trial::kRadius_m);
  const double fold = 0.5 * (1 - std::cos(0.4 * std::numbers::pi));  // at mass 8
  float most = 0;
  for (const SkinFrame& frame : tube.frames()) {
    const float mass = frame.along / static_cast<float>(2 * trial::kRadius_m);
    if (mass < 5.5f) {
      EXPECT_NEAR(frame.turn, 0, 1e-6f) << mass;
    }
    most = std::max(most, frame.turn);
  }
  EXPECT_NEAR(most, fold, 0.02);
}

TEST(TubeFrames, MassesInOnePlaceLeaveThemFinite) {
  TubeFrames tube(loops(), kGut_m);
  std::vector<geometry::Vec3> masses = loops();
  std::fill(masses.begin() + 10, masses.begin() + 20, masses[10]);
  std::fill(masses.begin(), masses.begin() + 4, masses[0]);
  for (const auto& place : {masses, std::vector<geometry::Vec3>(masses.size(), geometry::Vec3(1, 2, 3))}) {
    tube.deform(place);
    for (const Vertex& v : skinned_tube(tube.frames(), tube.radius_m(), make_tube_cylinder(1)).vertices)
      ASSERT_TRUE(v.position.allFinite() && v.normal.allFinite() && std::isfinite(v.openness));
  }
}

TEST(TubeFrames, MassesCloserThanTheTubeIsWideAreNotAllControlPoints) {
  const TubeFrames tube(rod(2001, 0.4), kGut_m);
  EXPECT_LT(tube.frames().size(), 100u);
  EXPECT_NEAR(tube.frames().back().origin.x(), 0.4f, 1e-6f) << "but it ends where it ends";
  EXPECT_NEAR(tube.rest_length_m(), 0.4, 1e-9);
}

TEST(TubeFrames, EachStepOfTheLadderCostsMore) {
  TubeFrames tube(trial::folding_axis(100, 0.4), trial::kRadius_m);
  std::size_t before = 0;
  for (const TubeResolution& resolution : kTubeLadder) {
    tube.set_eps(resolution.eps);
    const std::size_t vertices = tube_cost(tube.frames().size(), resolution.n).vertices;
    EXPECT_GT(vertices, before) << resolution.eps << ' ' << resolution.n;
    before = vertices;
  }
}

float palest_of(const TubeFrames& tube) {
  float most = 0;
  for (const SkinFrame& frame : tube.frames())
    for (const float wall : frame.walls) most = std::max(most, pallor_of(wall));
  return most;
}

TEST(TubeFrames, APressInTheMiddleOfAStraightPieceIsSeenThere) {
  TubeFrames tube(rod(11, 0.4), kGut_m);  // frames are 4 cm apart
  const std::size_t frames = tube.frames().size();
  const Press press{{0.22f, 0, 0.012f}, Vec3f::UnitZ(), 1};
  EXPECT_TRUE(tube.live(std::vector{press}, 0.5));
  EXPECT_GT(tube.frames().size(), frames) << "where it is pale it has more";
  EXPECT_GT(palest_of(tube), 0.3f);
  for (const SkinFrame& frame : tube.frames()) {
    for (std::size_t d = 0; d < SkinFrame::kDirections; ++d) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(d) / SkinFrame::kDirections;
      const Vec3f normal = std::cos(angle) * frame.k + std::sin(angle) * frame.t.cross(frame.k);
      const bool is_pale = pallor_of(frame.walls[d]) > 0;
      if (is_pale) {
        EXPECT_GT(normal.z(), 0) << "the other side is not pressed";
        EXPECT_NEAR(frame.origin.x(), 0.22f, 0.02f);
      }
      EXPECT_NEAR(openness_of(frame.walls[d]), 1, 0.01f) << "and light reaches it as before";
    }
  }
  for (int k = 0; k < 4; ++k) tube.live({}, 1);
  EXPECT_EQ(tube.frames().size(), frames);
}

TEST(TubeFrames, APressOnAFoldIsSeenWhereNoFrameStands) {
  std::vector<geometry::Vec3> corner = rod(11, 0.4);
  for (std::size_t i = 6; i < corner.size(); ++i)
    corner[i] = corner[5] + geometry::Vec3(0, 0.04 * (static_cast<double>(i) - 5), 0);
  TubeFrames tube(corner, kGut_m);
  for (const SkinFrame& frame : tube.frames())
    ASSERT_GT((frame.origin - corner[5].cast<float>()).norm(), 0.005f);
  const Vec3f top = corner[5].cast<float>() + Vec3f(0, 0, 0.012f);
  tube.live(std::vector{Press{top, Vec3f::UnitZ(), 1}}, 0.5);
  EXPECT_GT(palest_of(tube), 0.3f);
}

TEST(FoldShade, AllAroundIsWhatItIsInEachDirection) {
  TubeFrames tube(trial::folding_axis(60, 0.95), trial::kRadius_m);
  FoldShade shade = tube.shade();
  int shaded = 0;
  for (const SkinFrame& frame : tube.frames()) {
    shade.stand_at(frame.origin);
    for (std::size_t d = 0; d < SkinFrame::kDirections; ++d) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(d) / SkinFrame::kDirections;
      const Vec3f normal = std::cos(angle) * frame.k + std::sin(angle) * frame.t.cross(frame.k);
      const float one = shade.openness(frame.origin + tube.radius_m() * normal, normal);
      EXPECT_NEAR(openness_of(frame.walls[d]), one, 0.5f / kWallSteps + 1e-4f);
      if (one < 0.7f) ++shaded;
    }
  }
  EXPECT_GT(shaded, 10) << "legs lie beside each other";
}

}  // namespace
}  // namespace omentum::render
