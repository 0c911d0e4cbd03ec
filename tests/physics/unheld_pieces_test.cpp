#include "physics/unheld_pieces.h"

#include "tests/physics/held_bar.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::MeshEditor;
using geometry::TetId;
using test::HeldBody;

TEST(UnheldPiecesTest, FindsWhatNoSupportHolds) {
  const HeldBody body = test::held_bar();
  MeshEditor editor(body.mesh);
  UnheldPieces unheld(body.mesh, body.inertia.fixed);
  EXPECT_TRUE(unheld.find(editor).empty());
  (void)editor.remove(test::slice(body.mesh, 0.05, 0.06));
  const auto floating = unheld.find(editor);
  EXPECT_EQ(floating.size(), test::slice(body.mesh, 0.06, 1).size());
  (void)editor.remove(std::vector<TetId>(floating.begin(), floating.end()));
  EXPECT_TRUE(unheld.find(editor).empty());
}

TEST(UnheldPiecesTest, TwoHeldNodesAreAHinge) {
  HeldBody body = test::held_bar();
  std::ranges::fill(body.inertia.fixed, 0);
  body.inertia.fixed[0] = body.inertia.fixed[1] = kPinned;
  MeshEditor editor(body.mesh);
  EXPECT_EQ(UnheldPieces(body.mesh, body.inertia.fixed).find(editor).size(), body.mesh.tetrahedra.size());
  body.inertia.fixed[body.mesh.positions.size() - 1] = 7;
  EXPECT_TRUE(UnheldPieces(body.mesh, body.inertia.fixed).find(editor).empty());
}

}  // namespace
}  // namespace omentum::physics
