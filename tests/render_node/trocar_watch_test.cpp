// Whether a device goes through its tool's trocar, and what is drawn where it does not.
#include "render_node/trocar_watch.h"

#include "geometry/trocar.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

using geometry::Vec3;

const Vec3 kPort(0, -0.1, 0.2), kTipInside(0.02, 0, 0);

TEST(TrocarWatch, AShaftThatMissesIsDrawnThroughTheTrocarAndTold) {
  TrocarWatch watch(kPort);
  const Eigen::Quaterniond through = geometry::level_orientation(kPort - kTipInside);
  EXPECT_LT(watch.follow(kTipInside, through).angularDistance(through), 1e-7);
  EXPECT_FALSE(watch.misses());
  const double off_rad = 0.1, insertion_m = (kPort - kTipInside).norm();
  const Eigen::Quaterniond beside = through * Eigen::AngleAxisd(off_rad, Vec3::UnitX());
  EXPECT_LT(watch.follow(kTipInside, beside).angularDistance(through), 1e-7);
  EXPECT_TRUE(watch.misses());
  EXPECT_NEAR(*watch.largest_miss_m(), insertion_m * std::sin(off_rad), 1e-9);
  watch.follow(kTipInside, through);
  EXPECT_FALSE(watch.misses()) << "it is told while it lasts";
  EXPECT_GT(*watch.largest_miss_m(), 0.02) << "and at the end";
}

TEST(TrocarWatch, AToolWithoutATrocarIsDrawnAsItWasMeasured) {
  TrocarWatch watch(std::nullopt);
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
  EXPECT_EQ(watch.follow(kTipInside, q).coeffs(), q.coeffs());
  EXPECT_FALSE(watch.misses());
  EXPECT_FALSE(watch.largest_miss_m());
}

}  // namespace
}  // namespace omentum::render
