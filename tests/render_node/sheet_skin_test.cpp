#include "render_node/sheet_skin.h"

#include "closed_mesh.h"
#include "gut_organ.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

using geometry::Vec3;

constexpr float kSheetFloat = 1e-6f;  // m

std::size_t faces_apart(const SheetSkin& skin) {
  return skin.mesh().vertices.size() / 2;
}

FoldShade no_loops() {
  return FoldShade(0.01);
}

TEST(SheetSkin, IsClosedAndFacesOutwards) {
  const SheetSkin skin(test::gut_shape());
  EXPECT_TRUE(test::is_closed(skin.mesh()));
  EXPECT_TRUE(test::all_finite(skin.mesh()));
  EXPECT_GT(test::volume_m3(skin.mesh()), 0);
}

TEST(SheetSkin, ItsFewTrianglesCoverBothFacesAndFaceAsTheyDo) {
  const SheetSkin skin(test::gut_shape());
  const MeshData& mesh = skin.mesh();
  EXPECT_LE(mesh.few.size(), mesh.triangles.size() / SheetSkin::kAcross);
  float all_m2 = 0, few_m2 = 0, turned_m2 = 0;
  for (const MeshTriangle& t : mesh.triangles) all_m2 += test::area_of(mesh, t).norm();
  for (const MeshTriangle& t : mesh.few) {
    const Vec3f area = test::area_of(mesh, t);
    few_m2 += area.norm();
    Vec3f normals = Vec3f::Zero();
    for (const std::uint32_t corner : t) normals += mesh.vertices[corner].normal;
    if (area.dot(normals) < 0) turned_m2 += area.norm();
  }
  EXPECT_LT(turned_m2, 0.05f * few_m2) << "where its ends are drawn together alone";
  // all but the rim, and what the folds' chords leave out
  EXPECT_LT(few_m2, all_m2);
  EXPECT_GT(few_m2, 0.7f * all_m2);
}

TEST(SheetSkin, IsThinnerThanWhatCollides) {
  const geometry::GutShape gut = test::gut_shape();
  const SheetSkin skin(gut);
  const double thickness = SheetSkin::kDrawnThickness * gut.mesentery_thickness_m;
  for (std::size_t i = 0; i < faces_apart(skin); ++i) {
    const Vertex &front = skin.mesh().vertices[i], &back = skin.mesh().vertices[i + faces_apart(skin)];
    EXPECT_NEAR((front.position - back.position).norm(), thickness, kSheetFloat);
    EXPECT_LT((front.normal + back.normal).norm(), kSheetFloat);
    EXPECT_NEAR(front.normal.norm(), 1, 1e-5f);
  }
}

TEST(SheetSkin, GoesThroughItsMassesAndBeginsOnTheTubesAxis) {
  const geometry::GutShape gut = test::gut_shape();
  const SheetSkin skin(gut);
  std::vector<Vec3f> middle;
  for (std::size_t i = 0; i < faces_apart(skin); ++i)
    middle.push_back(
        0.5f * (skin.mesh().vertices[i].position + skin.mesh().vertices[i + faces_apart(skin)].position));
  for (const Vec3& mass : gut.positions) {
    float nearest = 1;
    for (const Vec3f& p : middle) nearest = std::min(nearest, (p - mass.cast<float>()).norm());
    EXPECT_LT(nearest, kSheetFloat);
  }
  geometry::TubeAxis axis(static_cast<std::size_t>(gut.layout.columns));
  axis.set(std::span(gut.positions).first(static_cast<std::size_t>(gut.layout.columns)));
  const std::size_t columns = middle.size() / (3 * SheetSkin::kAcross + 1);
  for (std::size_t c = 0; c < columns; ++c) {
    const double u = axis.end() * static_cast<double>(c) / static_cast<double>(columns - 1);
    EXPECT_LT((middle[c] - axis.at(u).place.cast<float>()).norm(), kSheetFloat);
  }
}

TEST(SheetSkin, MovesWithItsMassesAndKeepsItsPattern) {
  geometry::GutShape gut = test::gut_shape();
  SheetSkin skin(gut);
  const MeshData before = skin.mesh();
  for (Vec3& p : gut.positions) p += Vec3(0, 0, 0.1);
  skin.deform(gut.positions, no_loops());
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    const Vertex& v = skin.mesh().vertices[i];
    EXPECT_LT((v.position - before.vertices[i].position - Vec3f(0, 0, 0.1f)).norm(), 2 * kSheetFloat);
    EXPECT_EQ(v.rest, before.vertices[i].rest);
  }
}

TEST(SheetSkin, SharesOfTheMapLieWhereTheirMassesAre) {
  const geometry::GutShape gut = test::gut_shape();
  SheetSkin skin(gut);
  std::vector<float> shares(gut.positions.size());
  for (std::size_t m = 0; m < shares.size(); ++m) shares[m] = static_cast<float>(m % 7) / 7;
  skin.map(shares);
  skin.deform(gut.positions, no_loops());
  const std::size_t columns = skin.mesh().vertices.size() / 2 /
                              static_cast<std::size_t>(SheetSkin::kAcross * (gut.layout.rows - 1) + 1);
  const std::size_t steps = (columns - 1) / static_cast<std::size_t>(gut.layout.columns - 1);
  for (std::size_t c = 0; c < static_cast<std::size_t>(gut.layout.columns); ++c)
    EXPECT_FLOAT_EQ(skin.mesh().vertices[c * steps].share, shares[c]);
}

TEST(SheetSkin, WhatCollapsesStaysFinite) {
  const geometry::GutShape gut = test::gut_shape();
  SheetSkin skin(gut);
  skin.deform(std::vector<Vec3>(gut.positions.size(), Vec3(1, 2, 3)), no_loops());
  EXPECT_TRUE(test::all_finite(skin.mesh()));
}

TEST(SheetSkin, AnyGridOfMassesIsDrawn) {
  for (const std::int32_t columns : {4, 33, 400}) {
    for (const std::int32_t rows : {2, 3, 5}) {
      geometry::GutShape gut{{rows, columns}, {}, 0.01, 0.01};
      for (int m = 0; m < gut.layout.mass_count(); ++m)
        gut.positions.emplace_back(0.01 * (m % columns), 0.02 * (m / columns), 0);
      const SheetSkin skin(gut);
      EXPECT_TRUE(test::is_closed(skin.mesh()));
      EXPECT_EQ(test::flipped_triangles(skin.mesh()), 0) << rows << " x " << columns;
    }
  }
}

}  // namespace
}  // namespace omentum::render
