// What a trocar leaves of a pose. That collision follows it is tested with the hand's step.
#include "geometry/trocar.h"

#include <gtest/gtest.h>

namespace omentum::geometry {
namespace {

constexpr double kTrocarRounding = 1e-12;

const Vec3 kPivot(0.02, -0.15, 0.18), kTip(-0.01, 0.03, 0.01);
const Eigen::Quaterniond kMeasured =
    Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vec3(0.6, 0.1, -0.2).normalized()));

TEST(Trocar, AMeasuredShaftIsTurnedThroughThePivotWithoutRoll) {
  const Eigen::Quaterniond held = through_trocar(kTip, kMeasured, kPivot);
  EXPECT_GT(trocar_miss_m(kTip, kMeasured, kPivot), 0.01);
  EXPECT_LT(trocar_miss_m(kTip, held, kPivot), kTrocarRounding);
  const Eigen::AngleAxisd turn(held * kMeasured.conjugate());
  EXPECT_LT(std::abs(turn.axis().dot(kMeasured * Vec3::UnitZ())), 1e-9)
      << "the turn's axis is across the shaft";
  EXPECT_LT(through_trocar(kTip, held, kPivot).angularDistance(held), 1e-7) << "what passes it stays";
}

TEST(Trocar, AtThePivotTheMeasuredOrientationHolds) {
  const Eigen::Quaterniond held = through_trocar(kPivot + Vec3(0.001, 0, 0), kMeasured, kPivot);
  EXPECT_EQ(held.coeffs(), kMeasured.coeffs());
}

TEST(Trocar, ALevelOrientationHasItsXAxisLevelAndItsYAxisUp) {
  for (const Vec3& shaft : {Vec3(0, -1, 1), Vec3(0.3, 0.2, 0.1), Vec3(-1, 0, 0.01), Vec3(0.2, -0.4, -0.3)}) {
    const Eigen::Quaterniond q = level_orientation(shaft);
    EXPECT_LT((q * Vec3::UnitZ() - shaft.normalized()).norm(), kTrocarRounding);
    EXPECT_NEAR((q * Vec3::UnitX()).z(), 0, kTrocarRounding) << shaft.transpose();
    EXPECT_GT((q * Vec3::UnitY()).z(), 0) << shaft.transpose();
  }
  EXPECT_LT((level_orientation(Vec3(0, 0, 2)) * Vec3::UnitX() - Vec3::UnitX()).norm(), kTrocarRounding);
}

}  // namespace
}  // namespace omentum::geometry
