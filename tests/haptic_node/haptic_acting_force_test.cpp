#include "haptic_node/acting_force.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::haptic {
namespace {

constexpr double kDecay_s = 0.02, kValid_s = 0.005, kTick_s = 1e-3;
constexpr double kRounding_j = 1e-12;
const Vec3 kWay(0, 0, 1e-3);

Wrench force_z(double newton) {
  return {Vec3(0, 0, newton), Vec3::Zero()};
}

// One tick later an answer is written, or its write fails.
void tick(ActingForce& acting, double newton, bool written = true) {
  acting.age(kTick_s);
  if (written) acting.tell(force_z(newton), kValid_s, kTick_s);
}

TEST(ActingForce, NothingWasWrittenNothingActs) {
  const ActingForce acting(kDecay_s);
  EXPECT_EQ(acting.work(kWay, Vec3::Zero(), kTick_s).soon_j, 0);
  EXPECT_EQ(acting.work(kWay, Vec3::Zero(), kTick_s).late_j, 0);
}

TEST(ActingForce, ADeviceTurnsToAnAnswerAtOnceOrInItsNextPeriod) {
  ActingForce acting(kDecay_s);
  tick(acting, 1);
  tick(acting, 3);
  EXPECT_NEAR(acting.work(kWay, Vec3::Zero(), kTick_s).soon_j, 3e-3, kRounding_j);
  EXPECT_NEAR(acting.work(kWay, Vec3::Zero(), kTick_s).late_j, 1e-3, kRounding_j);
}

// A device of 100 Hz exerts what was written at the end of its interval, not what came first.
TEST(ActingForce, OfSeveralAnswersToOnePoseAnyMayAct) {
  ActingForce acting(kDecay_s);
  for (const double newton : {9.0, 1.0, 5.0, 2.0}) tick(acting, newton);
  EXPECT_NEAR(acting.work(kWay, Vec3::Zero(), 3 * kTick_s).soon_j, 5e-3, kRounding_j);
  EXPECT_NEAR(acting.work(kWay, Vec3::Zero(), 3 * kTick_s).late_j, 9e-3, kRounding_j);
}

TEST(ActingForce, WhenWritesFailTheLastOneIsHeldThenDecays) {
  ActingForce acting(kDecay_s);
  tick(acting, 4);
  const auto work_j = [&] { return acting.work(kWay, Vec3::Zero(), kTick_s).soon_j; };
  for (int ms = 2; ms <= 40; ++ms) {
    tick(acting, 0, false);
    const double held = 1 - (1e-3 * (ms - 1) - kValid_s) / kDecay_s;  // at the beginning of the way
    EXPECT_NEAR(work_j(), 4e-3 * std::clamp(held, 0.0, 1.0), kRounding_j) << ms << " ms";
  }
}

// Where the hand gave, the least that it may have given counts.
TEST(ActingForce, OfAForceThatDecayedOnTheWayTheWorseEndCounts) {
  ActingForce acting(kDecay_s);
  tick(acting, 4);
  acting.age(0.1);
  EXPECT_NEAR(acting.work(kWay, Vec3::Zero(), 0.1).soon_j, 4e-3, kRounding_j);
  EXPECT_EQ(acting.work(-kWay, Vec3::Zero(), 0.1).soon_j, 0);
}

// After an expiry a device lets the force fade in: what the hand put in is believed by its share only.
TEST(ActingForce, WhatAFadingForceTookFromTheHandIsNotOverrated) {
  constexpr double kLimit_n = 10, kFadeIn_s = 0.2;
  ActingForce acting(kDecay_s);
  acting.set_limits(kLimit_n, 0.5);
  acting.age(1);
  for (int ms = 1; ms <= 250; ++ms) {
    tick(acting, 4);
    const double exerted_n = std::min(4.0, kLimit_n * 1e-3 * ms / kFadeIn_s);
    EXPECT_NEAR(acting.work(-kWay, Vec3::Zero(), kTick_s / 2).soon_j, -1e-3 * exerted_n, kRounding_j) << ms;
    EXPECT_NEAR(acting.work(kWay, Vec3::Zero(), kTick_s / 2).soon_j, 4e-3, kRounding_j) << ms;
  }
}

TEST(ActingForce, TorqueWorksToo) {
  ActingForce acting(kDecay_s);
  acting.age(kTick_s);
  acting.tell({Vec3::Zero(), Vec3(0.1, 0, 0)}, kValid_s, kTick_s);
  EXPECT_NEAR(acting.work(kWay, Vec3(0.02, 0, 0), kTick_s).soon_j, 2e-3, kRounding_j);
}

}  // namespace
}  // namespace omentum::haptic
