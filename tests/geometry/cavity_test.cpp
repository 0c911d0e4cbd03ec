// The room around the phantom's organs holds them, and nothing of it is where they are.
#include "organ_tools/phantom/cavity_shape.h"
#include "organ_tools/phantom/gallbladder_shape.h"
#include "organ_tools/phantom/liver_shape.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::phantom {
namespace {

constexpr double kRoomGrid_m = 0.004;

template <class Use>
void for_grid(const Extent& box, double step_m, Use&& use) {
  for (double x = box.low.x(); x <= box.high.x(); x += step_m)
    for (double y = box.low.y(); y <= box.high.y(); y += step_m)
      for (double z = box.low.z(); z <= box.high.z(); z += step_m) use(Vec3(x, y, z));
}

TEST(CavityShape, HoldsLiverAndGallbladderAboveTheOmentum) {
  for (const ImplicitShape& organ : {liver(), gallbladder()}) {
    int inside = 0;
    for_grid(organ.extent, kRoomGrid_m, [&](const Vec3& p) {
      if (organ.distance(p) > 0) return;
      ++inside;
      EXPECT_LT(cavity_distance(p), -0.002) << organ.name << " at " << p.transpose();
      EXPECT_GT(omentum_distance(p), 0.001) << organ.name << " at " << p.transpose();
    });
    EXPECT_GT(inside, 100) << organ.name;
  }
}

TEST(CavityShape, ItAndItsOmentumLieInsideTheirExtents) {
  for (const ImplicitShape& shape : {cavity(), omentum()}) {
    const auto& [low, high] = shape.extent;
    for_grid(shape.extent, 0.015, [&, &low = low, &high = high](const Vec3& p) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double end : {low[axis], high[axis]}) {
          Vec3 on_face = p;
          on_face[axis] = end;
          EXPECT_GT(shape.distance(on_face), 0.001) << shape.name << " at " << on_face.transpose();
        }
      }
    });
  }
}

TEST(CavityShape, TheOmentumGoesFromWallToWallAtTheBottom) {
  for (const double x : {-0.15, -0.08, 0.0, 0.08, 0.15}) {
    for (const double y : {-0.3, -0.18, -0.06}) {
      EXPECT_LT(omentum_distance({x, y, -0.12}), 0) << x << ' ' << y;
      EXPECT_GT(omentum_distance({x, y, -0.05}), 0) << x << ' ' << y;
    }
  }
}

// Along the flank, from the diaphragm down: where the wall comes inwards and goes back again there is a rib.
TEST(CavityShape, RibsStandOutOfTheFlanks) {
  for (const double side : {-1.0, 1.0}) {
    std::vector<double> wall;  // how far out, at each y
    for (double y = 0.06; y > -0.15; y -= 0.002) {
      double x = 0;
      while (cavity_distance({side * x, y, 0}) < 0) x += 1e-4;
      wall.push_back(x);
    }
    int crests = 0;
    double deepest = 0;
    bool was_in = false;
    for (std::size_t i = 8; i + 8 < wall.size(); ++i) {
      const double in_by = 0.5 * (wall[i - 8] + wall[i + 8]) - wall[i];  // of places 16 mm to each side
      const bool is_in = in_by > 0.0015;
      crests += is_in && !was_in ? 1 : 0;
      was_in = is_in;
      deepest = std::max(deepest, in_by);
    }
    EXPECT_GE(crests, 4);
    EXPECT_LE(crests, 6);
    EXPECT_GT(deepest, 0.002);
    EXPECT_LT(deepest, 0.008) << "and it is a wall still";
  }
}

}  // namespace
}  // namespace omentum::phantom
