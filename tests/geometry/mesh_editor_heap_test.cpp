#include "geometry/mesh_editor.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::geometry {
namespace {

TEST(MeshEditorHeap, CutsAndRestoringTakeNothingFromTheHeap) {
  const TetraMesh mesh = test::make_box_mesh(6, 5, 5, {0.6, 0.5, 0.5});
  MeshEditor editor(mesh, {.smallest_piece_m3 = 1e-3});
  std::vector<TetId> order;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) order.emplace_back(t);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  std::vector<std::uint8_t> half(editor.removed_bits().size(), 0x5a);
  const std::span<const TetId> all = order;
  std::size_t asked = 0, repaired = 0, dropped = 0;

  const std::size_t before = test::heap_allocations();
  for (const std::size_t stroke : {1, 7, 400}) {
    for (std::size_t i = 0; i < all.size(); i += stroke) {
      const Removal removal = editor.remove(all.subspan(i, std::min(stroke, all.size() - i)));
      asked += removal.asked.size();
      repaired += removal.repaired.size();
      dropped += removal.dropped.size();
    }
    editor.set_removed(half);
    editor.restore();
  }
  const std::size_t after = test::heap_allocations();

  EXPECT_EQ(after, before);
  EXPECT_EQ(asked + repaired + dropped, 3 * all.size());
  EXPECT_GT(repaired, 0u);
  EXPECT_GT(dropped, 0u);
}

}  // namespace
}  // namespace omentum::geometry
