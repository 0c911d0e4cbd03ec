#include "device_bridge/force_hold.h"

#include "tests/support/milliseconds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace omentum::device {
namespace {

constexpr double kMaxForce_n = 10, kMaxTorque_nm = 0.5;
using test::kMs;

msg::ToolForce answer(const Vec3& force, double valid_for_s = 0.005) {
  msg::ToolForce answer;
  answer.force = to_message(force);
  answer.torque = to_message(0.01 * force);
  answer.valid_for_s = valid_for_s;
  return answer;
}

TEST(ForceHold, ExertsNothingBeforeTheFirstAnswer) {
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  EXPECT_EQ(hold.at(0).force.norm(), 0);
  EXPECT_EQ(hold.at(1000 * kMs).force.norm(), 0);
  EXPECT_EQ(hold.expired(), 0u);
}

// A hold whose force has faded in already: answers of `force` for a second before time zero.
ForceHold holding(const Vec3& force) {
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  for (std::int64_t ms = -1000; ms < 0; ++ms) {
    EXPECT_TRUE(hold.take(answer(force), ms * kMs));
    (void)hold.at(ms * kMs);
  }
  return hold;
}

TEST(ForceHold, HoldsAnAnswerWhileItIsValidThenLetsItDecayToZero) {
  ForceHold hold = holding({0, 0, 2});
  ASSERT_TRUE(hold.take(answer({0, 0, 2}), 0));
  EXPECT_EQ(hold.at(0).force, Vec3(0, 0, 2));
  EXPECT_EQ(hold.at(5 * kMs).force, Vec3(0, 0, 2));
  double last = 2;
  for (int ms = 6; ms < 25; ++ms) {
    const double now = hold.at(ms * kMs).force.z();
    EXPECT_LT(now, last);
    EXPECT_GT(now, 0);
    last = now;
  }
  EXPECT_EQ(hold.at(25 * kMs).force.norm(), 0);
  EXPECT_EQ(hold.at(9000 * kMs).torque.norm(), 0);
  EXPECT_EQ(hold.expired(), 1u);
}

TEST(ForceHold, WhileAnswersComeInTimeTheyAreExertedAsTheyAre) {
  ForceHold hold = holding({0, 0, 0.1});
  ASSERT_TRUE(hold.take(answer({0, 0, 8}), 0));
  EXPECT_EQ(hold.at(0).force, Vec3(0, 0, 8));
  EXPECT_EQ(hold.expired(), 0u);
}

// The largest step of the force from one millisecond to the next while `force` is answered in each of them,
// from `begin_ms` on until all of it is exerted.
double largest_step_n(ForceHold& hold, const Vec3& force, std::int64_t begin_ms) {
  Vec3 before = hold.at(begin_ms * kMs).force;
  double largest_n = 0;
  for (std::int64_t ms = begin_ms; before != force; ++ms) {
    if (ms > begin_ms + 1000) return std::numeric_limits<double>::infinity();  // it never comes back
    EXPECT_TRUE(hold.take(answer(force), ms * kMs));
    const Vec3 now = hold.at(ms * kMs).force;
    largest_n = std::max(largest_n, (now - before).norm());
    before = now;
  }
  return largest_n;
}

// what may come back in a millisecond, with room for rounding
constexpr double kStep_n = kMaxForce_n / ForceHold::kFadeIn_s * 1e-3 * (1 + 1e-9);

TEST(ForceHold, AfterAnExpiryTheForceFadesInFromZero) {
  ForceHold hold = holding({0, 0, 8});
  EXPECT_EQ(hold.at(40 * kMs).force.norm(), 0);
  EXPECT_LE(largest_step_n(hold, {0, 0, 8}, 40), kStep_n);
}

TEST(ForceHold, AnAnswerThatEndsTheDecayFadesInFromWhatIsLeft) {
  ForceHold hold = holding({0, 0, 2});
  const double left_n = hold.at(14 * kMs).force.z();
  ASSERT_GT(left_n, 0);
  ASSERT_LT(left_n, 2);
  EXPECT_LE(largest_step_n(hold, {0, 0, 8}, 14), kStep_n);
}

TEST(ForceHold, TheFirstAnswerOfAllFadesIn) {
  // the node may have answered for long, before the way back to the device was found
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  EXPECT_LE(largest_step_n(hold, {0, 0, 8}, 0), kStep_n);
}

// One arrives on another thread, after the tick's moment and before it is looked at.
TEST(ForceHold, AnAnswerFromAfterTheTicksMomentFadesInFromNothing) {
  for (const Vec3& force : {Vec3(0, 0, 0), Vec3(0, 0, 2)}) {
    ForceHold hold(kMaxForce_n, kMaxTorque_nm);
    ASSERT_TRUE(hold.take(answer(force), 2 * kMs));
    EXPECT_EQ(hold.at(1 * kMs).force, Vec3(0, 0, 0));
    EXPECT_EQ(hold.at(1 * kMs).torque, Vec3(0, 0, 0));
    EXPECT_GE(hold.at(3 * kMs).force.z(), 0);
  }
}

TEST(ForceHold, AnExpiryThatNobodyLookedAtFadesInToo) {
  // the device's loop stood still: its motors still exert what was commanded last
  ForceHold hold = holding({0, 0, 1});
  ASSERT_TRUE(hold.take(answer({0, 0, 8}), 50 * kMs));
  EXPECT_LE((hold.at(50 * kMs).force - Vec3(0, 0, 1)).norm(), kStep_n);
}

TEST(ForceHold, WhileItFadesInAForceFallsAtOnceAndTorqueKeepsItsShare) {
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  ASSERT_TRUE(hold.take(answer({0, 0, 8}), 0));
  (void)hold.at(0);
  ASSERT_TRUE(hold.take(answer({0, 0, 8}), 4 * kMs));
  const Wrench partial = hold.at(4 * kMs);
  EXPECT_LT(partial.force.z(), 1);
  EXPECT_TRUE(partial.torque.isApprox(0.01 * partial.force));
  ASSERT_TRUE(hold.take(answer({0, 0, 0}), 5 * kMs));
  EXPECT_EQ(hold.at(5 * kMs).force.norm(), 0);
}

TEST(ForceHold, AnAnswerThatIsNotFiniteIsRefusedAndTheOldOneKept) {
  ForceHold hold = holding({1, 0, 0});
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(hold.take(answer({0, bad, 0}), 1));
    msg::ToolForce grip = answer({0, 0, 0});
    grip.grip_torque = bad;
    EXPECT_FALSE(hold.take(grip, 1));
  }
  EXPECT_EQ(hold.at(1).force, Vec3(1, 0, 0));
}

TEST(ForceHold, LimitsAreTheDevicesAndKeepTheDirection) {
  ForceHold hold = holding({300, -400, 0});
  EXPECT_TRUE(hold.at(0).force.isApprox(Vec3(6, -8, 0)));
  EXPECT_NEAR(hold.at(0).torque.norm(), kMaxTorque_nm, 1e-12);
}

TEST(ForceHold, AValidityThatIsNoTimeCountsAsNone) {
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    ForceHold hold(kMaxForce_n, kMaxTorque_nm);
    ASSERT_TRUE(hold.take(answer({1, 0, 0}, bad), 0));
    EXPECT_EQ(hold.at(20 * kMs).force.norm(), 0) << bad;
  }
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  ASSERT_TRUE(hold.take(answer({1, 0, 0}, std::numeric_limits<double>::infinity()), 0));
  EXPECT_EQ(hold.at(1000 * kMs).force.norm(), 0);
}

}  // namespace
}  // namespace omentum::device
