#include "physics/hybrid/mesh_split.h"

#include "physics/stiffness.h"
#include "tests/physics/hybrid/hybrid_beam.h"

#include <gmock/gmock.h>

namespace omentum::physics {
namespace {

using geometry::NodeId;
using geometry::TetId;
using test::HybridBeam;

TEST(MeshSplitTest, EachTetrahedronIsInOnePartWithItsOwnNodesInOrder) {
  const HybridBeam beam;
  std::size_t found = 0;
  for (const MeshPart* part : {&beam.split.precomputed, &beam.split.dynamic}) {
    const bool is_dynamic = part == &beam.split.dynamic;
    found += part->tetrahedron.size();
    EXPECT_TRUE(std::ranges::is_sorted(part->node));
    for (std::size_t t = 0; t < part->tetrahedron.size(); ++t) {
      const TetId whole = part->tetrahedron[t];
      EXPECT_EQ(part->own_tetrahedron[whole], TetId(t));
      EXPECT_EQ(beam.dynamic[whole] != 0, is_dynamic);
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_EQ(part->node[part->mesh.tetrahedra[t][c]], beam.mesh.tetrahedra[whole][c]);
    }
  }
  EXPECT_EQ(found, beam.mesh.tetrahedra.size());
}

TEST(MeshSplitTest, ConnectionNodesAreThoseOfBothParts) {
  const HybridBeam beam;
  std::vector<NodeId> expected;
  for (std::size_t n = 0; n < beam.mesh.positions.size(); ++n)
    if (std::abs(beam.mesh.positions[n].x() - 0.06) < 1e-12) expected.emplace_back(n);
  EXPECT_THAT(beam.split.connection, testing::ContainerEq(expected));
}

// No stiffness is lost or counted twice.
TEST(MeshSplitTest, BothPartsTogetherAreTheWhole) {
  const HybridBeam beam;
  const test::Values u = test::random_values(beam.components(), 1e-3, 5);
  std::vector<Vec3> whole;
  for (std::size_t n = 0; n < beam.mesh.positions.size(); ++n) whole.emplace_back(u.data() + 3 * n);
  std::vector<Vec3> left = holding_forces(assemble_stiffness(beam.mesh, beam.material), whole);
  for (const MeshPart* part : {&beam.split.precomputed, &beam.split.dynamic}) {
    std::vector<Vec3> own;
    for (const NodeId n : part->node) own.push_back(whole[n]);
    const std::vector<Vec3> forces = holding_forces(assemble_stiffness(part->mesh, beam.material), own);
    for (std::size_t n = 0; n < forces.size(); ++n) left[part->node[n]] -= forces[n];
  }
  for (const Vec3& f : left) EXPECT_LE(f.norm(), 1e-12);
}

}  // namespace
}  // namespace omentum::physics
