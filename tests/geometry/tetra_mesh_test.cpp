#include "geometry/tetra_mesh.h"
#include "geometry/surface.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace omentum::geometry {
namespace {

TEST(CheckMesh, BoxOfTetrahedraFillsItsVolume) {
  const TetraMesh mesh = test::make_box_mesh(3, 2, 4, {0.3, 0.2, 0.4});
  double volume = 0;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    const double v =
        signed_volume(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], mesh.positions[t[3]]);
    EXPECT_GT(v, 0);
    volume += v;
  }
  EXPECT_NEAR(volume, 0.3 * 0.2 * 0.4, 1e-15);
}

}  // namespace
}  // namespace omentum::geometry
