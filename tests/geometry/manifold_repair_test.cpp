#include "geometry/manifold_repair.h"

#include "geometry/mesh_editor.h"
#include "tests/geometry/books_from_scratch.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace omentum::geometry {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<TetId> listed(std::span<const TetId> tetrahedra) {
  return {tetrahedra.begin(), tetrahedra.end()};
}

std::vector<TetId> cubes(const std::vector<int>& numbers) {
  std::vector<TetId> all;
  for (const int cube : numbers) {
    for (int i = 0; i < 6; ++i) all.emplace_back(6 * cube + i);
  }
  return all;
}

// Tetrahedra around a common edge, in turn.
TetraMesh wheel(int spokes) {
  RawMesh raw;
  raw.source = "wheel";
  raw.positions = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < spokes; ++i) {
    const double angle = 2 * std::numbers::pi * i / spokes;
    raw.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    raw.tetrahedra.push_back({0, 1, 2 + i, 2 + (i + 1) % spokes});
  }
  return check_mesh(raw, 1).mesh;
}

TEST(ManifoldRepair, OfFansAtAnEdgeTheLargestStays) {
  const TetraMesh mesh = wheel(8);
  MeshEditor editor(mesh);

  EXPECT_THAT(editor.remove(std::array{TetId(0)}).repaired, IsEmpty());
  const Removal removal = editor.remove(std::array{TetId(3)});

  EXPECT_THAT(listed(removal.asked), ElementsAre(TetId(3)));
  EXPECT_THAT(listed(removal.repaired), ElementsAre(TetId(1), TetId(2)));
  EXPECT_EQ(not_manifold(editor, mesh), "");
}

TEST(ManifoldRepair, OfEqualFansTheOneWithTheLowestNumberStays) {
  const TetraMesh mesh = wheel(6);
  MeshEditor editor(mesh);

  const Removal removal = editor.remove(std::array{TetId(3), TetId(0)});

  EXPECT_THAT(listed(removal.repaired), ElementsAre(TetId(4), TetId(5)));
}

TEST(ManifoldRepair, OfFansAtANodeTheLargestStays) {
  // the first and the last cube of eight meet in the middle node only
  const TetraMesh mesh = test::make_box_mesh(2, 2, 2, {1, 1, 1});
  MeshEditor editor(mesh);

  const Removal removal = editor.remove(cubes({1, 2, 3, 4, 5, 6}));

  EXPECT_THAT(listed(removal.repaired), ElementsAreArray(cubes({7})));
  EXPECT_EQ(not_manifold(editor, mesh), "");
}

TEST(ManifoldRepair, WhatHangsOnWhatIsTakenGoesToo) {
  // four cubes in a square, of which two meet along an edge only
  const TetraMesh mesh = test::make_box_mesh(2, 2, 1, {1, 1, 1});
  MeshEditor editor(mesh);

  const Removal removal = editor.remove(cubes({1, 2}));

  EXPECT_THAT(removal.repaired, testing::Not(IsEmpty()));
  EXPECT_GE(mesh.tetrahedra.size() - static_cast<std::size_t>(editor.removed_count()), 6u);
  EXPECT_EQ(not_manifold(editor, mesh), "");
}

// Pairs of tetrahedra inside a box that share the node in its middle alone.
std::vector<std::array<TetId, 2>> opposite_pairs(const TetraMesh& mesh, NodeId middle) {
  std::vector<std::array<TetId, 2>> pairs;
  const TetraLinks links(mesh.tetrahedra, mesh.positions.size());
  for (const TetId a : links.around(middle)) {
    for (const TetId b : links.around(middle)) {
      int shared = 0;
      for (const NodeId n : links.nodes(a)) shared += std::ranges::count(links.nodes(b), n) > 0 ? 1 : 0;
      if (a < b && shared == 1) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST(ManifoldRepair, HollowsThatTouchInANodeBecomeOne) {
  const TetraMesh mesh = test::make_box_mesh(4, 4, 4, {1, 1, 1});
  const NodeId middle(62);
  const auto pairs = opposite_pairs(mesh, middle);
  ASSERT_THAT(pairs, testing::Not(IsEmpty()));
  for (const auto& [a, b] : pairs) {
    MeshEditor editor(mesh);
    ASSERT_THAT(editor.remove(std::array{a}).repaired, IsEmpty());
    const Removal removal = editor.remove(std::array{b});

    EXPECT_THAT(removal.repaired, testing::Not(IsEmpty()));
    EXPECT_LE(removal.repaired.size(), 6u);  // a way between them, and what it leaves hanging
    EXPECT_GT(editor.uses(middle), 10);
    EXPECT_EQ(editor.piece_count(), 1);
    EXPECT_EQ(not_manifold(editor, mesh), "");
  }
}

TEST(ManifoldRepair, NamesNothingWhereNothingWasRemoved) {
  const TetraMesh mesh = test::make_box_mesh(3, 3, 3, {1, 1, 1});
  const TetraLinks links(mesh.tetrahedra, mesh.positions.size());
  const RemainingTetrahedra left(links);
  ManifoldRepair repair(left);

  for (std::int32_t n = 0; n < links.node_count(); ++n) repair.note(NodeId(n));

  EXPECT_THAT(repair.next(), IsEmpty());
}

}  // namespace
}  // namespace omentum::geometry
