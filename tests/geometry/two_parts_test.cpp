#include "organ_tools/phantom/two_parts.h"

#include "geometry/touching_faces.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace omentum::phantom {
namespace {

double volume_m3(const TetraMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    sum +=
        geometry::signed_volume(mesh.positions[a], mesh.positions[b], mesh.positions[c], mesh.positions[d]);
  return sum;
}

TEST(TwoParts, EightTimesFinerIsTheSameBody) {
  const TetraMesh mesh = test::make_box_mesh(2, 2, 3, {0.04, 0.03, 0.05});
  const TetraMesh finer = eight_times_finer(mesh);
  EXPECT_EQ(finer.tetrahedra.size(), 8 * mesh.tetrahedra.size());
  EXPECT_NEAR(volume_m3(finer), volume_m3(mesh), 1e-15);
  EXPECT_EQ(geometry::extract_surface(finer, {}).triangles.size(),
            4 * geometry::extract_surface(mesh, {}).triangles.size());
}

TEST(TwoParts, PartsLieOnEachOtherWithoutGapOrOverlap) {
  const TetraMesh mesh = test::make_box_mesh(3, 3, 4, {0.03, 0.03, 0.04});
  auto [upper, lower] = parted_at(mesh, 0.02);
  EXPECT_EQ(upper.tetrahedra.size() + lower.tetrahedra.size(), mesh.tetrahedra.size());
  upper = eight_times_finer(upper);
  EXPECT_NEAR(volume_m3(upper) + volume_m3(lower), volume_m3(mesh), 1e-15);
  const geometry::Surface of_upper = geometry::extract_surface(upper, {}),
                          of_lower = geometry::extract_surface(lower, {});
  const geometry::BoundedMesh a{upper, of_upper}, b{lower, of_lower};
  const std::size_t faces = geometry::faces_on(b, a, 1e-9).size();
  EXPECT_EQ(faces, 2u * 9);
  EXPECT_EQ(geometry::faces_on(a, b, 1e-9).size(), 4 * faces);
  EXPECT_LE(geometry::deepest_inside(a, b), 1e-12);
}

}  // namespace
}  // namespace omentum::phantom
