#include "geometry/mesh_editor.h"

#include "geometry/surface.h"
#include "tests/geometry/books_from_scratch.h"
#include "tests/geometry/cut_trials.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <random>

namespace omentum::geometry {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Cubes of 1 m^3, six tetrahedra each.
TetraMesh bar(int cubes) {
  return test::make_box_mesh(cubes, 1, 1, {1.0 * cubes, 1, 1});
}

std::vector<TetId> cube(int number) {
  std::vector<TetId> six;
  for (int i = 0; i < 6; ++i) six.emplace_back(6 * number + i);
  return six;
}

std::string difference(const MeshEditor& editor, const TetraMesh& mesh) {
  return difference_from_scratch(editor, mesh, extract_surface(mesh, {}).node);
}

std::vector<TetId> shuffled(std::size_t count, std::uint32_t seed) {
  std::vector<TetId> all;
  for (std::size_t t = 0; t < count; ++t) all.emplace_back(t);
  std::shuffle(all.begin(), all.end(), std::mt19937(seed));
  return all;
}

TEST(MeshEditor, BeginsWithTheWholeMesh) {
  const TetraMesh mesh = test::make_box_mesh(3, 2, 2, {0.3, 0.2, 0.2});
  const MeshEditor editor(mesh);

  EXPECT_EQ(editor.removed_count(), 0);
  EXPECT_EQ(editor.removed_bits().size(), (mesh.tetrahedra.size() + 7) / 8);
  EXPECT_EQ(editor.faces().size(), extract_surface(mesh, {}).triangles.size());
  EXPECT_EQ(editor.piece_count(), 1);
  EXPECT_EQ(difference(editor, mesh), "");
}

TEST(MeshEditor, RemovesWhatIsAskedForAndTellsIt) {
  const TetraMesh mesh = bar(4);
  MeshEditor editor(mesh);

  const Removal removal = editor.remove(cube(0));

  EXPECT_THAT(std::vector(removal.asked.begin(), removal.asked.end()), testing::ElementsAreArray(cube(0)));
  EXPECT_THAT(removal.repaired, IsEmpty());
  EXPECT_THAT(removal.dropped, IsEmpty());
  EXPECT_EQ(editor.removed_count(), 6);
  EXPECT_EQ(difference(editor, mesh), "");
}

TEST(MeshEditor, IgnoresWhatIsGoneRepeatedOrOutOfRange) {
  const TetraMesh mesh = bar(3);
  MeshEditor editor(mesh);
  editor.remove(cube(0));

  const std::array asked = {TetId(0), TetId{}, TetId(18), TetId(1 << 30), TetId(6), TetId(6)};
  const Removal removal = editor.remove(asked);

  EXPECT_THAT(removal.asked, ElementsAre(TetId(6)));
  EXPECT_EQ(difference(editor, mesh), "");
}

TEST(MeshEditor, AnswersOneRemovalAtATime) {
  const TetraMesh mesh = bar(3);
  MeshEditor editor(mesh);
  editor.remove(cube(0));

  const Removal nothing = editor.remove({});

  EXPECT_THAT(nothing.asked, IsEmpty());
  EXPECT_THAT(nothing.repaired, IsEmpty());
}

TEST(MeshEditor, CutsABodyInTwoAndKeepsBoth) {
  const TetraMesh mesh = bar(5);
  MeshEditor editor(mesh);

  const Removal removal = editor.remove(cube(1));

  EXPECT_THAT(removal.dropped, IsEmpty());
  EXPECT_EQ(editor.piece_count(), 2);
  EXPECT_EQ(editor.piece_of(TetId(0)), editor.piece_of(TetId(5)));
  EXPECT_NE(editor.piece_of(TetId(0)), editor.piece_of(TetId(12)));
  EXPECT_EQ(difference(editor, mesh), "");
}

TEST(MeshEditor, DropsPiecesBelowTheSmallestSize) {
  const TetraMesh mesh = bar(8);
  MeshEditor editor(mesh, {.smallest_piece_m3 = 2.5});

  const Removal two = editor.remove(cube(2));
  EXPECT_THAT(std::vector(two.dropped.begin(), two.dropped.end()), testing::SizeIs(12));
  EXPECT_EQ(editor.piece_count(), 1);

  EXPECT_THAT(editor.remove(cube(6)).dropped, testing::SizeIs(6));
  EXPECT_EQ(difference(editor, mesh), "");

  // three cubes are left, and become too few
  EXPECT_THAT(editor.remove(cube(3)).dropped, testing::SizeIs(12));
  EXPECT_EQ(editor.removed_count(), 48);
  EXPECT_EQ(editor.piece_count(), 0);
}

// Neither to repair what a removal left, nor with a small piece; the rest stays manifold all the same.
TEST(MeshEditor, WhatIsKeptGoesOnlyWhenItIsAskedFor) {
  const TetraMesh mesh = test::make_box_mesh(5, 4, 4, {0.5, 0.4, 0.4});
  std::vector<std::uint8_t> kept;
  for (const Tetrahedron& nodes : mesh.tetrahedra) {
    double x = 0;
    for (const NodeId n : nodes) x = std::max(x, mesh.positions[static_cast<std::size_t>(n)].x());
    kept.push_back(x < 0.301 ? 1 : 0);
  }
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    MeshEditor editor(mesh, {.smallest_piece_m3 = 1, .kept = kept});
    std::uint32_t removals = seed;  // books are compared after every third one, another in each order
    for (const TetId t : shuffled(mesh.tetrahedra.size(), seed)) {
      if (kept[static_cast<std::size_t>(t)] != 0) continue;
      editor.remove(std::array{t});
      if (++removals % 3 == 0) {
        ASSERT_EQ(difference(editor, mesh), "") << t;
      }
      for (std::size_t k = 0; k < kept.size(); ++k) ASSERT_FALSE(kept[k] != 0 && editor.is_removed(TetId(k)));
    }
    editor.remove(std::array{TetId(0)});
    EXPECT_TRUE(editor.is_removed(TetId(0)));
  }
}

TEST(MeshEditor, UncutSurfaceKeepsThePlacesThatItIsGiven) {
  const TetraMesh mesh = test::make_box_mesh(4, 4, 4, {0.4, 0.4, 0.4});
  std::vector<bool> pinned(mesh.positions.size(), false);
  pinned[3] = pinned[17] = true;
  const Surface surface = extract_surface(mesh, pinned);
  MeshEditor editor(mesh, {.uncut_surface = surface.node});

  const std::vector<TetId> order = shuffled(mesh.tetrahedra.size(), 4);
  for (std::size_t i = 0; i < order.size(); i += 5) {
    editor.remove(std::span(order).subspan(i, std::min<std::size_t>(5, order.size() - i)));
    ASSERT_TRUE(std::ranges::equal(editor.surface_nodes().first(surface.node.size()), surface.node));
  }
  EXPECT_EQ(editor.surface_nodes().size(), surface.node.size());
}

TEST(MeshEditor, SurfaceFollowsFromTheSetAlone) {
  const TetraMesh mesh = test::make_box_mesh(5, 4, 4, {0.5, 0.4, 0.4});
  MeshEditor cut(mesh), told(mesh), told_at_once(mesh);
  for (const TetId t : shuffled(120, 8)) {
    cut.remove(std::array{t});
    told.set_removed(cut.removed_bits());
  }
  told_at_once.set_removed(cut.removed_bits());

  for (const MeshEditor* other : {&told, &told_at_once}) {
    EXPECT_TRUE(std::ranges::equal(other->surface_nodes(), cut.surface_nodes()));
    EXPECT_TRUE(std::ranges::equal(other->removed_bits(), cut.removed_bits()));
    EXPECT_EQ(other->piece_count(), cut.piece_count());
    EXPECT_EQ(difference(*other, mesh), "");
  }
}

TEST(MeshEditor, TakesUpSetsOfAnyLength) {
  const TetraMesh mesh = bar(3);
  MeshEditor editor(mesh);

  editor.set_removed(std::vector<std::uint8_t>(100, 0xff));
  EXPECT_EQ(editor.removed_count(), 18);
  EXPECT_EQ(editor.removed_bits().back(), 0x03);

  editor.set_removed(std::array<std::uint8_t, 1>{0x3f});
  EXPECT_EQ(editor.removed_count(), 6);
  EXPECT_EQ(difference(editor, mesh), "");
}

TEST(MeshEditor, RestoresTheUncutMesh) {
  const TetraMesh mesh = test::make_box_mesh(3, 3, 3, {0.3, 0.3, 0.3});
  MeshEditor editor(mesh);
  for (const TetId t : shuffled(60, 2)) editor.remove(std::array{t});

  editor.restore();

  EXPECT_EQ(editor.removed_count(), 0);
  EXPECT_EQ(editor.piece_count(), 1);
  EXPECT_EQ(difference(editor, mesh), "");
}

TEST(MeshEditor, CuttingEverythingAwayEndsQuietly) {
  const TetraMesh mesh = test::make_box_mesh(3, 3, 3, {0.3, 0.3, 0.3});
  MeshEditor editor(mesh);

  for (const TetId t : shuffled(mesh.tetrahedra.size(), 3)) {
    editor.remove(std::array{t});
    ASSERT_EQ(not_manifold(editor, mesh), "");
  }

  EXPECT_EQ(editor.removed_count(), 162);
  EXPECT_EQ(editor.piece_count(), 0);
  EXPECT_THAT(editor.faces(), IsEmpty());
  EXPECT_THAT(editor.remove(cube(0)).asked, IsEmpty());
}

class CutSequences : public testing::TestWithParam<const char*> {};

TEST_P(CutSequences, KeepTheBooksAndStayManifold) {
  const std::string name = GetParam();
  TetraMesh mesh;
  if (name == "box") {
    mesh = test::make_box_mesh(3, 3, 2, {0.3, 0.3, 0.2});
  } else if (name == "plate") {
    mesh = test::make_box_mesh(5, 5, 1, {0.5, 0.5, 0.1});
  } else {
    const std::filesystem::path file = test::data_file(name);
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
    mesh = check_mesh(read_mesh(file), 1e-3).mesh;
  }
  for (std::uint32_t seed = 0; seed < std::max(1u, test::tried(6u)); ++seed)
    ASSERT_EQ(try_cut_sequence(mesh, seed), "") << "seed " << seed;
}

INSTANTIATE_TEST_SUITE_P(Meshes, CutSequences,
                         testing::Values("box", "plate", "tet/sofaenv_liver_coarse.vtk"),
                         [](const auto& info) { return "mesh" + std::to_string(info.index); });

}  // namespace
}  // namespace omentum::geometry
