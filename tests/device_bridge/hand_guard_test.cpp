#include "device_bridge/hand_guard.h"

#include "tests/support/milliseconds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace omentum::device {
namespace {

using node::EnergyTank;

constexpr double kGuardedForce_n = 10, kGuardedTorque_nm = 0.5;
using test::kMs;
constexpr double kRounding = 1e-9;

Wrench force_z(double newton) {
  Wrench wrench;
  wrench.force.z() = newton;
  return wrench;
}

// A guard, the hand that it guards, and what that hand received.
struct GuardBench {
  explicit GuardBench(bool is_simulated = false, std::uint32_t axes = 0)
      : guard(kGuardedForce_n, kGuardedTorque_nm, axes), simulated(is_simulated) {}

  // `ms` later: what is exerted of what is asked, and the hand is measured at `tip`
  Vec3 tick(const Wrench& asked, const Vec3& tip, std::int64_t ms = 1, bool usable = true) {
    now_ns += ms * kMs;
    const Vec3 before = exerted;
    exerted = guard.limit(asked, now_ns).force;
    work_j += (simulated ? exerted : before).dot(tip - at);
    at = tip;
    guard.follow({.valid = usable, .measured_ns = now_ns, .position = tip}, usable, simulated);
    return exerted;
  }
  Vec3 rest(const Wrench& asked, int ticks) {
    for (int i = 1; i < ticks; ++i) tick(asked, at);
    return tick(asked, at);
  }

  HandGuard guard;
  bool simulated;
  std::int64_t now_ns = 0;
  Vec3 at = Vec3::Zero(), exerted = Vec3::Zero();
  double work_j = 0;
};

TEST(HandGuard, AForceFallsAtOnceAndRisesAndTurnsByItsSlew) {
  GuardBench bench;
  constexpr double kStep_n = HandGuard::kFastest_n_s * 1e-3;
  bench.rest({}, 10);
  EXPECT_NEAR(bench.rest(force_z(9), 1).z(), kStep_n, kRounding);
  EXPECT_NEAR(bench.rest(force_z(9), 10).z(), 9, kRounding);
  EXPECT_NEAR(bench.rest(force_z(1), 1).z(), 1, kRounding);
  bench.rest(force_z(9), 10);
  EXPECT_NEAR(bench.rest(force_z(-9), 1).z(), -kStep_n, kRounding) << "down to nothing, and then it rises";
  bench.rest(force_z(9), 10);
  Wrench aside;
  aside.force.x() = 9;
  EXPECT_LE((bench.rest(aside, 1) - Vec3(kStep_n, 0, 0)).norm(), kRounding);
}

TEST(HandGuard, AStallIsNoReasonToStep) {
  for (const std::int64_t period_ms : {1, 3}) {
    for (const std::int64_t stall_ms : {3, 5, 20, 200}) {
      GuardBench bench;
      for (int i = 0; i < 10; ++i) bench.tick({}, Vec3::Zero(), period_ms);
      const double nominal_n = HandGuard::kFastest_n_s * 1e-3 * static_cast<double>(period_ms);
      EXPECT_LE(bench.tick(force_z(9), Vec3::Zero(), stall_ms).z(), nominal_n + kRounding);
      EXPECT_LE(bench.tick(force_z(9), Vec3::Zero(), period_ms).z(), 2 * nominal_n + kRounding);
    }
  }
}

TEST(HandGuard, WhatItDoesNotKnowToBeExertedDoesNoWork) {
  GuardBench bench(false, msg::AXIS_X | msg::AXIS_Y);
  EXPECT_EQ(bench.rest(force_z(5), 100), Vec3::Zero());
}

// The hand sets off as quickly as hands do and goes along the force for ever, in hardware and in a
// simulation.
TEST(HandGuard, GivesNoMoreThanTheBound) {
  for (const bool simulated : {false, true}) {
    for (const double speed : {0.01, 0.1, 0.4, 1.0}) {
      GuardBench bench(simulated);
      bench.rest(force_z(9), 100);
      for (int i = 0; i < 5000; ++i) {
        bench.tick(force_z(9), bench.at + Vec3(0, 0, 1e-3 * std::min(speed, 0.02 * i)));
        ASSERT_LE(bench.work_j, EnergyTank::kBound_j) << speed << " m/s, " << i;
      }
      EXPECT_NEAR(bench.guard.tank().given_j(), bench.work_j, kRounding) << "it knows what it did";
    }
  }
}

// Tissue that pushes jaws open whichever way they go.
TEST(HandGuard, GivesJawsNoMoreThanTheBoundAndWithoutAMotorNothing) {
  for (const std::uint32_t axes : {0u, std::uint32_t{msg::AXIS_GRIP}, std::uint32_t{msg::AXIS_X}}) {
    HandGuard guard(kGuardedForce_n, kGuardedTorque_nm, axes);
    double work_j = 0, exerted_nm = 0, opened_rad = 0, largest_nm = 0;
    for (int i = 1; i <= 5000; ++i) {
      const double before = opened_rad, acting_nm = exerted_nm;
      opened_rad = 0.3 + 0.3 * std::sin(0.05 * i);
      exerted_nm = guard.limit({.grip_torque = 0.3}, i * kMs).grip_torque;
      EXPECT_LE(std::abs(exerted_nm) - std::abs(acting_nm), HandGuard::kFastest_nm_s * 1e-3 + kRounding);
      if (i > 1) work_j += std::max(0.0, acting_nm * (opened_rad - before));
      guard.follow({.valid = true, .measured_ns = i * kMs, .grip = opened_rad}, true, false);
      largest_nm = std::max(largest_nm, exerted_nm);
      ASSERT_LE(guard.tank().given_j(), EnergyTank::kBound_j) << i;
    }
    EXPECT_EQ(largest_nm > 0, axes != msg::AXIS_X);
    EXPECT_EQ(work_j > 0, axes != msg::AXIS_X);
  }
}

// A tracker of 100 Hz in a loop of 1 kHz, and a force that acts only where the hand is not seen.
TEST(HandGuard, AForceBetweenTwoLooksCounts) {
  GuardBench bench;
  bench.rest({}, 10);
  Vec3 tip = Vec3::Zero(), seen = Vec3::Zero();
  std::int64_t seen_ns = bench.now_ns;
  double work_j = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 way(0, 0, 1e-4);
    work_j += bench.exerted.dot(way);
    tip += way;
    bench.now_ns += kMs;
    bench.exerted = bench.guard.limit(force_z(i % 10 == 0 || i % 10 == 9 ? 0 : 9), bench.now_ns).force;
    if (i % 10 == 0) seen = tip, seen_ns = bench.now_ns;
    bench.guard.follow({.valid = true, .measured_ns = seen_ns, .position = seen}, true, false);
    ASSERT_LE(work_j, EnergyTank::kBound_j) << i;
  }
  EXPECT_GT(bench.guard.held_back(), 0u);
}

TEST(HandGuard, ASpringIsGivenBackWhole) {
  constexpr double kStiffness_n_m = 500;
  GuardBench bench;
  bench.rest({}, 10);
  for (int i = 0; i < 4000; ++i) {
    const double depth = 0.008 * (1 - std::cos(2 * M_PI * 1e-3 * i));
    const Wrench asked = force_z(kStiffness_n_m * depth);
    ASSERT_EQ(bench.tick(asked, {0, 0, -depth}), asked.force) << i;
  }
  EXPECT_EQ(bench.guard.held_back(), 0u);
}

// A hand that rubbed for long put in a joule. A force that comes from nowhere does not get it.
TEST(HandGuard, HeatIsNotGivenBack) {
  GuardBench bench;
  bench.rest({}, 10);
  for (int i = 0; i < 10'000; ++i) {
    Wrench friction;
    friction.force.x() = -1;
    bench.tick(friction, bench.at + Vec3(1e-4, 0, 0));
  }
  bench.rest({}, 10);
  const double put_in_j = -bench.work_j;
  ASSERT_GT(put_in_j, 0.9);
  for (int i = 0; i < 2000; ++i) bench.tick(force_z(9), bench.at + Vec3(0, 0, 1e-4));
  EXPECT_LE(bench.work_j + put_in_j, EnergyTank::kBound_j + EnergyTank::kRefill_w * 2);
}

// What a loop that stood still gave cannot be helped. It is not given again, and the hand pays it back.
TEST(HandGuard, AStandstillIsADebtThatIsPaidBeforeAnythingElse) {
  GuardBench bench;
  bench.rest(force_z(5), 100);
  for (int stall = 0; stall < 20; ++stall) {
    bench.tick(force_z(5), bench.at + Vec3(0, 0, 0.02), 50);
    for (int i = 0; i < 20; ++i) bench.tick(force_z(5), bench.at + Vec3(0, 0, 4e-4));
  }
  EXPECT_LE(bench.work_j, 5 * 0.02 + EnergyTank::kBound_j) << "one standstill's worth";
  for (int i = 0; i < 5000; ++i) bench.tick({}, bench.at + Vec3(0, 0, 1e-4));
  EXPECT_LE(bench.work_j, EnergyTank::kReserve_j);
  EXPECT_NEAR(bench.rest(force_z(5), 30).z(), 5, kRounding) << "the force is back";
}

TEST(HandGuard, WhereTheHandIsNotSeenItIsTakenToGoOn) {
  GuardBench bench;
  bench.rest(force_z(2), 100);
  for (int i = 0; i < 10; ++i) bench.tick(force_z(2), bench.at + Vec3(0, 0, 1e-4));
  const double seen_j = bench.guard.tank().given_j();
  for (int i = 0; i < 10; ++i) bench.tick(force_z(2), bench.at, 1, false);
  EXPECT_NEAR(bench.guard.tank().given_j() - seen_j, 2 * 1e-3, 1e-5);
  // found again elsewhere: nobody carried it there by force
  bench.tick(force_z(2), {1, 1, 1});
  EXPECT_NEAR(bench.guard.tank().given_j() - seen_j, 2 * 1e-3, 1e-5);
}

}  // namespace
}  // namespace omentum::device
