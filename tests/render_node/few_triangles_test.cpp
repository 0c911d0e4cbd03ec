#include "render_node/few_triangles.h"

#include "render_node/shape_pieces.h"

#include "closed_mesh.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr float kShaft_m = 0.004f, kShaftLength_m = 0.2f;

float area_m2(const MeshData& mesh, const std::vector<MeshTriangle>& triangles) {
  float sum = 0;
  for (const MeshTriangle& t : triangles) sum += test::area_of(mesh, t).norm();
  return sum;
}

TEST(FewTriangles, OfAShaftKeepItsLengthAndMostOfItsSurface) {
  MeshData shaft = sleeve(kShaft_m, 0, kShaftLength_m);
  const std::size_t before = shaft.triangles.size();
  add_few_triangles(shaft, 0.5f * kShaft_m);
  EXPECT_EQ(shaft.triangles.size(), before);
  EXPECT_FALSE(shaft.few.empty());
  EXPECT_LT(2 * shaft.few.size(), before);
  EXPECT_GT(area_m2(shaft, shaft.few), 0.8f * area_m2(shaft, shaft.triangles));
  float lowest = kShaftLength_m, highest = 0;
  for (const MeshTriangle& t : shaft.few) {
    Vec3f normals = Vec3f::Zero();
    for (const std::uint32_t corner : t) {
      const Vertex& v = shaft.vertices[corner];
      lowest = std::min(lowest, v.position.z());
      highest = std::max(highest, v.position.z());
      normals += v.normal;
    }
    EXPECT_GT(test::area_of(shaft, t).dot(normals), 0) << "turned over";
  }
  EXPECT_LT(lowest, kShaft_m);
  EXPECT_GT(highest, kShaftLength_m - kShaft_m);
}

TEST(FewTriangles, AreNoneWhereLittleIsGained) {
  MeshData shaft = sleeve(kShaft_m, 0, kShaftLength_m);
  add_few_triangles(shaft, 0.01f * kShaft_m);
  EXPECT_TRUE(shaft.few.empty());
}

}  // namespace
}  // namespace omentum::render
