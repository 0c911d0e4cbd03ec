#include "node_common/energy_tank.h"

#include <gtest/gtest.h>

#include <cmath>

namespace omentum::node {
namespace {

using Vec3 = Eigen::Vector3d;
constexpr double kTick_s = 1e-3;
constexpr double kRounding_j = 1e-12;

// A hand that went on at this velocity for long enough to be known.
HandMotion going(const Vec3& velocity) {
  HandMotion motion;
  for (int i = 0; i < 20; ++i) motion.follow(velocity * kTick_s, Vec3::Zero(), kTick_s);
  return motion;
}

TEST(EnergyTank, LetsThroughWhatItCovers) {
  EnergyTank tank;
  EXPECT_EQ(tank.share(0), 1);
  EXPECT_EQ(tank.share(EnergyTank::kReserve_j), 1);
  EXPECT_NEAR(tank.share(2 * EnergyTank::kReserve_j), 0.5, kRounding_j);
  tank.observe(EnergyTank::kReserve_j, 0, kTick_s);
  EXPECT_EQ(tank.share(0), 1) << "what does nothing may leave";
  EXPECT_EQ(tank.share(1e-9), 0);
}

TEST(EnergyTank, WhatTheHandPutInItMayHaveBack) {
  EnergyTank tank;
  for (int i = 0; i < 100; ++i) tank.observe(-1e-3, 1e-3 * (i + 1), kTick_s);
  EXPECT_NEAR(tank.level_j(), 0.1 + EnergyTank::kReserve_j, kRounding_j);
}

// Friction's heat cannot push a hand, nor can a tissue that says that it stored what nobody put in.
TEST(EnergyTank, HoldsNoMoreThanTheTissueStoresAndNoMoreThanWasPutIn) {
  EnergyTank rubbed;
  rubbed.observe(-1, 0.02, kTick_s);
  EXPECT_NEAR(rubbed.level_j(), 0.02 + EnergyTank::kReserve_j, kRounding_j);
  EnergyTank liar;
  for (int i = 0; i < 10'000; ++i) liar.observe(0, 1e6, kTick_s);
  EXPECT_EQ(liar.level_j(), EnergyTank::kReserve_j);
}

TEST(EnergyTank, TheReserveComesBackOutOfWhatTheHandLostAndOfNothingElse) {
  const auto waited = [](EnergyTank tank) {
    for (int i = 0; i < 60'000; ++i) tank.observe(0, 0, kTick_s);
    return tank.level_j();
  };
  EnergyTank spent;
  spent.observe(4e-3, 0, kTick_s);
  EXPECT_NEAR(waited(spent), EnergyTank::kReserve_j - 4e-3, kRounding_j) << "time alone brings nothing";
  EnergyTank rubbed;
  rubbed.observe(-3e-3, 0, kTick_s);
  rubbed.observe(4e-3, 0, kTick_s);
  EXPECT_NEAR(waited(rubbed), EnergyTank::kReserve_j - 1e-3, 1e-9);
  EXPECT_NEAR(rubbed.level_j(), EnergyTank::kReserve_j - 4e-3, EnergyTank::kRefill_w * 2 * kTick_s)
      << "slowly";
}

TEST(EnergyTank, ADebtIsPaidByAHandThatMovesHoweverLargeItIs) {
  for (const double debt_j : {2e-3, 20e-3, 1.0}) {
    for (const double speed : {0.05, 0.3}) {
      EnergyTank tank;
      tank.observe(EnergyTank::kReserve_j + debt_j, 0, kTick_s);
      const HandMotion motion = going({speed, 0, 0});
      double paid_s = 0;
      for (; tank.level_j() < EnergyTank::kLow_j && paid_s < 200; paid_s += kTick_s) {
        const Vec3 force = tank.damping(motion, kTick_s);
        ASSERT_LE(force.dot(motion.velocity), 0) << "a damper resists";
        ASSERT_LE(force.norm(), EnergyTank::kMostDamping_n * (1 + 1e-9));
        tank.observe(force.dot(motion.velocity) * kTick_s, 0, kTick_s);
      }
      // a moment to begin, and then at least half of what the damper takes at its best
      const double best_w =
          std::min(EnergyTank::kMaxDamping_n_s_m * speed, EnergyTank::kMostDamping_n) * speed;
      EXPECT_LE(paid_s, 1 + 2 * (debt_j + EnergyTank::kFullDamping_j) / best_w) << debt_j << " J";
      EXPECT_TRUE(tank.damping(motion, kTick_s).isZero(0));
    }
  }
}

TEST(EnergyTank, AHandThatKeepsTurningIsNotDamped) {
  EnergyTank tank;
  tank.observe(8e-3, 0, kTick_s);
  HandMotion motion;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 way(i / 3 % 2 == 0 ? 1e-3 : -1e-3, 0, 0);
    motion.follow(way, Vec3::Zero(), kTick_s);
    ASSERT_TRUE(tank.damping(motion, kTick_s).isZero(0));
  }
}

TEST(WorkAhead, CoversAnyHandThatTurnsRoundOrSpeedsUpAsHandsDo) {
  const Vec3 force(3, 0, -4), torque(0, 0.1, 0);
  HandMotion motion;
  motion.follow({1e-4, 0, 0}, {0, 0, 2e-3}, kTick_s);  // 0.1 m/s, 2 rad/s
  for (const double horizon_s : {1e-3, 2e-3, 7e-3}) {
    const double farthest_m = 0.1 * horizon_s + 0.5 * 20 * horizon_s * horizon_s;
    const double turned_rad = 2 * horizon_s + 0.5 * 400 * horizon_s * horizon_s;
    EXPECT_NEAR(work_ahead_j(force, torque, motion, horizon_s), 5 * farthest_m + 0.1 * turned_rad,
                kRounding_j);
  }
  // it seems to stand still: it did not a moment ago
  motion.follow(Vec3::Zero(), Vec3::Zero(), kTick_s);
  EXPECT_GT(work_ahead_j(force, torque, motion, kTick_s), 5 * 0.08 * kTick_s);
}

}  // namespace
}  // namespace omentum::node
