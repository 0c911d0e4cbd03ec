#include "physics/intestine/gut_parts.h"

#include "geometry/segment_points.h"
#include "tests/physics/intestine/restless_gut.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::Vec3;

TEST(GutDistance, AgreesWithThePlainerAnswer) {
  std::mt19937_64 random(21);
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<Vec3, 5> at;
    for (Vec3& p : at) p = test::random_vector(random, 0.05);
    if (trial % 7 == 0) at[4] = at[3];                     // a triangle without area
    if (trial % 11 == 0) at[3] = at[2] + (at[1] - at[0]);  // parallel to an edge
    const auto segments = geometry::closest_points_of_segments(at[0], at[1], at[2], at[3]);
    EXPECT_NEAR(between_segments(at[0], at[1], at[2], at[3]).distance_m, std::sqrt(segments.squared_distance),
                1e-9);
    const auto triangle = geometry::closest_points_of_segment_and_triangle(at[0], at[1], at[2], at[3], at[4]);
    const PairPlaces places = between_segment_and_triangle(at[0], at[1], {&at[2], &at[3], &at[4]}, 1);
    EXPECT_NEAR(places.distance_m, std::sqrt(triangle.squared_distance), 1e-9);
    const Vec3 other = places.other[0] * at[2] + places.other[1] * at[3] + places.other[2] * at[4];
    EXPECT_NEAR((at[0] + places.s * (at[1] - at[0]) - other).norm(), places.distance_m, 1e-9);
  }
}

TEST(GutDistance, OfWhatIsFarItSaysSo) {
  const Vec3 p(0, 0, 0.3), q(0.1, 0, 0.2), a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const double bound = between_segment_and_triangle(p, q, {&a, &b, &c}, 0.1).distance_m;
  EXPECT_GT(bound, 0.1);
  EXPECT_LE(bound, 0.2);
}

TEST(GutDistance, SegmentsSideBySideMeetInTheMiddle) {
  const PairPlaces places = between_segments(Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 1, 0), Vec3(6, 1, 0));
  EXPECT_NEAR(places.s, 0.75, 1e-12);
  EXPECT_NEAR(places.other[1], 0.25, 1e-12);
}

TEST(GutParts, AFineGutHasNoMoreThanItsRadiusAsksFor) {
  const GutParts coarse(test::folded_gut(100)), fine(test::folded_gut(801));
  EXPECT_EQ(coarse.stride, 1);
  EXPECT_EQ(coarse.layout, coarse.gut);
  EXPECT_EQ(fine.stride, 2);
  EXPECT_EQ(fine.layout.columns, 401);
  EXPECT_EQ(fine.masses.front()[1], fine.gut.mass(0, 2));
  EXPECT_EQ(fine.masses.back()[2], fine.gut.mass(3, 800));
}

// Each place that is least is told of once, whoever shares it.
TEST(GutParts, APlaceThatPartsShareIsReportedOnce) {
  geometry::GutShape shape{{3, 24}, std::vector<Vec3>(72), 0.02, 0.01};
  for (std::int32_t r = 0; r < 3; ++r)
    for (std::int32_t c = 0; c < 24; ++c)
      shape.positions[shape.layout.mass(r, c)] = Vec3(0.05 * c, 0.05 * r, 0);
  for (std::int32_t c = 16; c < 24; ++c) {  // back over the sheet, a corner low over a corner
    const bool low = c == 20;
    shape.positions[shape.layout.mass(0, c)] = Vec3(0.2 + 0.05 * (20 - c), 0.05, low ? 0.02 : 0.06);
  }
  const GutParts parts(shape);
  int reported = 0, found = 0;
  for (std::int32_t i = 16; i < 23; ++i) {
    for (std::int32_t t = parts.layout.segment_count(); t < parts.count(); ++t) {
      if (!parts.may_touch(i, t) || parts.along[static_cast<std::size_t>(t)] > 12) continue;
      const PairPlaces places = measure(parts, shape.positions, i, t, 1);
      if (places.distance_m > 0.0201) continue;
      ++found;
      reported += reports(parts, i, t, places) ? 1 : 0;
    }
  }
  EXPECT_EQ(found, 12);  // two segments, six triangles
  EXPECT_EQ(reported, 1);
}

}  // namespace
}  // namespace omentum::physics
