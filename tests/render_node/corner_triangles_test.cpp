#include "render_node/corner_triangles.h"
#include "render_node/surface_refinement.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

// Two triangles that share an edge.
const std::vector<geometry::Triangle> kPair{
    {geometry::SurfaceId(0), geometry::SurfaceId(1), geometry::SurfaceId(2)},
    {geometry::SurfaceId(2), geometry::SurfaceId(1), geometry::SurfaceId(3)}};

TEST(CornerTriangles, OfARefinedSurfaceAreTheTrianglesItWasMadeOf) {
  for (const int level : {1, 2, 3, 4}) {
    const SurfaceRefinement refined(kPair, 4, level);
    EXPECT_EQ(corner_triangles(refined.triangles(), level), (std::vector<MeshTriangle>{{0, 1, 2}, {2, 1, 3}}))
        << "level " << level;
  }
}

TEST(CornerTriangles, WhatWasCutAwayIsAPoint) {
  std::vector<MeshTriangle> triangles = SurfaceRefinement(kPair, 4, 3).triangles();
  std::fill_n(triangles.begin(), 9, MeshTriangle{});
  EXPECT_EQ(corner_triangles(triangles, 3), (std::vector<MeshTriangle>{{0, 0, 0}, {2, 1, 3}}));
}

}  // namespace
}  // namespace omentum::render
