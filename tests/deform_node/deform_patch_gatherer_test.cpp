#include "deform_node/patch_gatherer.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <set>

namespace omentum::deform {
namespace {

using geometry::NodeId;
using geometry::TetId;
using geometry::Vec3;

constexpr std::size_t kMost = 24;

class PatchGathererTest : public testing::Test {
 protected:
  geometry::TetraMesh mesh_ = test::make_box_mesh(6, 6, 3, Vec3(0.06, 0.06, 0.03));
  geometry::MeshEditor editor_{mesh_};
  std::vector<double> u_ = std::vector<double>(3 * mesh_.positions.size());
  PatchGatherer gatherer_{mesh_, kMost};
  LocalPatch patch_{kMost};
};

TEST_F(PatchGathererTest, ItTakesFacesOfTheSurfaceAroundThePlaceOutwardAndEachOnce) {
  const Vec3 top(0.03, 0.03, 0.03);
  ASSERT_TRUE(gatherer_.gather({0, top, 0.012}, editor_, u_, patch_));
  ASSERT_EQ(gatherer_.nodes().size(), patch_.node_count);
  std::set<std::array<std::uint8_t, 3>> seen;
  for (std::size_t i = 0; i < patch_.triangle_count; ++i) {
    const auto& corners = patch_.triangles[i];
    EXPECT_TRUE(seen.insert(corners).second);
    std::array<Vec3, 3> x;
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_LT(corners[c], patch_.node_count);
      x[c] = mesh_.positions[gatherer_.nodes()[corners[c]]];
      EXPECT_EQ(patch_.nodes[corners[c]],
                static_cast<std::uint32_t>(mesh_.file_node[gatherer_.nodes()[corners[c]]]));
      EXPECT_NEAR(x[c].z(), top.z(), 1e-12);
    }
    EXPECT_GT((x[1] - x[0]).cross(x[2] - x[0]).z(), 0);
  }
  EXPECT_GE(patch_.triangle_count, 8u);
}

TEST_F(PatchGathererTest, AToolInTheMiddleOfALargeFaceFindsIt) {
  const Vec3 middle(0.003, 0.0065, 0.03);  // of a face whose corners are farther away than the radius
  ASSERT_TRUE(gatherer_.gather({0, middle, 0.002}, editor_, u_, patch_));
  EXPECT_EQ(patch_.triangle_count, 1u);
}

TEST_F(PatchGathererTest, FarFromTheSurfaceThereIsNone) {
  EXPECT_FALSE(gatherer_.gather({0, Vec3(0.03, 0.03, 0.06), 0.015}, editor_, u_, patch_));
  EXPECT_EQ(patch_.triangle_count, 0u);
}

TEST_F(PatchGathererTest, WhereNotAllFitTheNearestDo) {
  const Vec3 top(0.03, 0.03, 0.03);
  ASSERT_TRUE(gatherer_.gather({0, top, 1}, editor_, u_, patch_));
  EXPECT_LE(patch_.node_count, kMost);
  for (std::size_t i = 0; i < patch_.node_count; ++i)
    EXPECT_LT((mesh_.positions[gatherer_.nodes()[i]] - top).norm(), 0.035);
}

TEST_F(PatchGathererTest, WhatIsHeldBelongsToItBeforeWhatIsNearAndFromAnyDistance) {
  const auto& held = editor_.faces().front().nodes;
  const Vec3 far = mesh_.positions[held[0]] + Vec3(0.2, 0, 0);
  for (const auto& [centre, radius_m] : {std::pair{Vec3(0.03, 0.03, 0.03), 1.0}, std::pair{far, 0.015}}) {
    ASSERT_TRUE(gatherer_.gather({0, centre, radius_m, held}, editor_, u_, patch_));
    for (std::size_t c = 0; c < held.size(); ++c) EXPECT_EQ(gatherer_.nodes()[c], held[c]);
  }
  EXPECT_EQ(patch_.triangle_count, 1u) << "far away it is all there is";
  EXPECT_FALSE(gatherer_.gather({0, far, 0.015}, editor_, u_, patch_)) << "held by an earlier place only";
}

TEST_F(PatchGathererTest, ItFollowsDeformationAndCuts) {
  for (std::size_t n = 0; n < mesh_.positions.size(); ++n) u_[3 * n + 2] = 0.1;
  EXPECT_FALSE(gatherer_.gather({0, Vec3(0.03, 0.03, 0.03), 0.01}, editor_, u_, patch_));
  ASSERT_TRUE(gatherer_.gather({0, Vec3(0.03, 0.03, 0.13), 0.01}, editor_, u_, patch_));
  const auto above = [&](TetId t) {
    double z = 0;
    for (const NodeId n : mesh_.tetrahedra[t]) z += mesh_.positions[n].z() / 4;
    return z > 0.02;
  };
  std::vector<TetId> gone;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t)
    if (above(TetId(t))) gone.emplace_back(t);
  editor_.remove(gone);
  EXPECT_FALSE(gatherer_.gather({0, Vec3(0.03, 0.03, 0.13), 0.005}, editor_, u_, patch_));
  EXPECT_TRUE(gatherer_.gather({0, Vec3(0.03, 0.03, 0.12), 0.005}, editor_, u_, patch_));
}

}  // namespace
}  // namespace omentum::deform
