#include "device_bridge/glide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omentum::device {
namespace {

constexpr double kGlideStep_s = 1e-3;
constexpr double kGlideRounding = 1e-9;

TEST(Glide, SpeedAndAccelerationAreBoundedWhateverIsWanted) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  Motion now;
  Vec3 wanted = Vec3::Zero();
  for (int i = 0; i < 5000; ++i) {
    if (i % 33 == 0) wanted = {place(random), place(random), place(random)};
    const Motion next = glide(now, wanted, kGlideStep_s);
    EXPECT_LE(next.velocity.norm(), kFastestGlide_m_s + kGlideRounding);
    EXPECT_LE((next.velocity - now.velocity).norm(), kGlideAcceleration_m_s2 * kGlideStep_s + kGlideRounding);
    EXPECT_EQ(next.position, now.position + next.velocity * kGlideStep_s);
    now = next;
  }
}

TEST(Glide, ArrivesFromAnyDistanceWithoutGoingPast) {
  for (const double far_m : {1e-4, 0.01, 0.5}) {
    Motion now;
    double most_m = 0;
    for (int i = 0; i < 2000; ++i) {
      now = glide(now, {far_m, 0, 0}, kGlideStep_s);
      most_m = std::max(most_m, now.position.x());
    }
    EXPECT_NEAR(now.position.x(), far_m, 1e-6 * far_m);
    EXPECT_LE(most_m, far_m * (1 + kGlideRounding)) << far_m;
  }
}

TEST(Glide, StepsOfThirtyRaysASecondBecomeOneMotion) {
  constexpr double kHand_m_s = 0.1;
  Motion now;
  double slowest = 1, fastest = 0;
  for (int i = 0; i < 3000; ++i) {
    const double told_s = 0.033 * std::floor(i / 33.0);
    now = glide(now, {kHand_m_s * told_s, 0, 0}, kGlideStep_s);
    if (i < 1000) continue;  // until it has come up
    slowest = std::min(slowest, now.velocity.x());
    fastest = std::max(fastest, now.velocity.x());
  }
  // exp(-T / tau) of a first-order follower whose place is told every T: 0.52 from the top of each step on
  const double ripple = std::exp(-0.033 / kGlide_s);
  EXPECT_GT(slowest, 0.95 * ripple * fastest);
  EXPECT_LT(fastest, 1.5 * kHand_m_s);
}

TEST(Glide, AShaftTurnsTheShortWayNoFasterThanIsSaid) {
  const Quat wanted(Eigen::AngleAxisd(-0.5, Vec3::UnitX()));
  Quat now = Quat::Identity();
  for (int i = 0; i < 100; ++i) {
    const Quat next = turn_towards(now, wanted, 2, kGlideStep_s);
    EXPECT_LE(next.angularDistance(now), 2 * kGlideStep_s + kGlideRounding);
    EXPECT_LT(next.angularDistance(wanted), now.angularDistance(wanted));
    now = next;
  }
  for (int i = 0; i < 200; ++i) now = turn_towards(now, wanted, 2, kGlideStep_s);
  EXPECT_LT(now.angularDistance(wanted), kGlideRounding);
}

}  // namespace
}  // namespace omentum::device
