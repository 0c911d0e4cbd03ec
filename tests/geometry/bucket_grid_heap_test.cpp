#include "geometry/bucket_grid.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace omentum::geometry {
namespace {

TEST(BucketGridHeap, UpdatesAndQueriesTakeNothingFromTheHeap) {
  const TetraMesh mesh = test::make_box_mesh(8, 7, 6, {0.16, 0.14, 0.12});
  const Surface surface = extract_surface(mesh, {});
  const std::vector<Vec3> rest = surface_positions(mesh, surface);
  std::vector<Vec3> now = rest;
  BucketGrid grid(surface, rest, BucketGrid::suitable_slack(surface, rest));
  int visits = 0;

  const std::size_t before = test::heap_allocations();
  for (int step = 0; step < 200; ++step) {
    // every tenth step stretches far into the overflow list, every thirtieth is not finite
    const double stretch =
        step % 30 == 29 ? std::numeric_limits<double>::quiet_NaN() : (step % 10 == 9 ? 8.0 : 1.0);
    for (std::size_t s = 0; s < rest.size(); ++s) {
      now[s] = stretch * rest[s] + 0.05 * std::sin(0.1 * step + 20 * rest[s].x()) * Vec3::UnitZ();
    }
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) grid.update(TriangleId(t), now);
    grid.visit_segment({-1, -1, -1}, {1, 1, 1}, 0.01, [&](TriangleId) { ++visits; });
    grid.visit_segment({0.08, 0.07, 1e9}, {0.08, 0.07, -1e9}, 0, [&](TriangleId) { ++visits; });
    visits += grid.nearest({0.3, 0.2, 0.1}, 1.0, now).has_value();
  }
  const std::size_t after = test::heap_allocations();

  EXPECT_EQ(after, before);
  EXPECT_GT(visits, 0);
}

}  // namespace
}  // namespace omentum::geometry
