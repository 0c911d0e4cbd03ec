// Base frame and trocar lever: velocities are those with which poses move, and no transform makes or loses
// power.
#include "tests/device_bridge/frames/random_hand.h"

#include <gtest/gtest.h>

namespace omentum::device {
namespace {

using test::RandomHand;

constexpr int kHands = 200;
// Of central differences over 1e-5 s: their own error is the third derivative times 1e-10 / 6, with
// turns of 10 rad/s about levers of 0.1 m below 1e-6.
constexpr double kDifference_s = 1e-5, kDifferenceError = 1e-5;
constexpr double kRounding = 1e-12;  // of sums of a dozen products of order 10

template <class Transform>
void expect_its_own_velocities(const Measurement& hand, const Transform& transform) {
  const Measurement now = transform(hand), before = transform(test::moved(hand, -kDifference_s)),
                    after = transform(test::moved(hand, kDifference_s));
  const Vec3 velocity = (after.position - before.position) / (2 * kDifference_s);
  const Vec3 turning = test::turn_between(before.orientation, after.orientation) / (2 * kDifference_s);
  EXPECT_LT((now.linear_velocity - velocity).norm(), kDifferenceError);
  EXPECT_LT((now.angular_velocity - turning).norm(), kDifferenceError);
}

TEST(BaseFrame, VelocitiesAreThoseOfThePoses) {
  RandomHand random(1);
  for (int i = 0; i < kHands; ++i) {
    const BaseFrame base = random.base();
    expect_its_own_velocities(random.hand(Vec3::Zero()),
                              [&](const Measurement& hand) { return to_scene(base, hand); });
  }
}

TEST(BaseFrame, HandAndToolHaveTheSamePower) {
  RandomHand random(2);
  for (int i = 0; i < kHands; ++i) {
    const BaseFrame base = random.base();
    const Measurement hand = random.hand(Vec3::Zero());
    const Wrench wrench = random.wrench();
    EXPECT_NEAR(test::power_w(to_base(base, wrench), hand), test::power_w(wrench, to_scene(base, hand)),
                kRounding);
  }
}

TEST(BaseFrame, FineMotionIsFeltAsLittleAsItIsWide) {
  const BaseFrame fine{.scale = 0.2};
  const Wrench felt = to_base(fine, {.force = {0, 0, 5}, .torque = {0.1, 0, 0}});
  EXPECT_DOUBLE_EQ(felt.force.z(), 1);
  EXPECT_DOUBLE_EQ(felt.torque.x(), 0.1);
}

TEST(BaseFrame, TheWayBackEndsWhereItBegan) {
  RandomHand random(3);
  for (int i = 0; i < kHands; ++i) {
    const BaseFrame base = random.base();
    const Measurement hand = random.hand(Vec3::Zero()), again = to_base(base, to_scene(base, hand));
    EXPECT_LT((again.position - hand.position).norm(), kRounding);
    EXPECT_LT((again.linear_velocity - hand.linear_velocity).norm(), kRounding);
    EXPECT_LT((again.angular_velocity - hand.angular_velocity).norm(), kRounding);
    EXPECT_LT(test::turn_between(again.orientation, hand.orientation).norm(), 1e-7);
  }
}

TEST(TrocarLever, TheShaftGoesThroughThePivot) {
  RandomHand random(4);
  for (int i = 0; i < kHands; ++i) {
    const TrocarLever lever = random.lever();
    const Measurement handle = random.handle(lever), tip = at_tip(lever, handle);
    const Vec3 z = tip.orientation * Vec3::UnitZ();
    EXPECT_NEAR((handle.position - tip.position).norm(), lever.length_m, kRounding);
    EXPECT_LT((handle.position - tip.position - lever.length_m * z).norm(), kRounding);
    EXPECT_LT((lever.pivot - tip.position).cross(z).norm(), kRounding);
  }
}

TEST(TrocarLever, VelocitiesAreThoseOfThePoses) {
  RandomHand random(5);
  for (int i = 0; i < kHands; ++i) {
    const TrocarLever lever = random.lever();
    expect_its_own_velocities(random.handle(lever),
                              [&](const Measurement& handle) { return at_tip(lever, handle); });
  }
}

TEST(TrocarLever, HandleAndTipHaveTheSamePower) {
  RandomHand random(6);
  for (int i = 0; i < kHands; ++i) {
    const TrocarLever lever = random.lever();
    const Measurement handle = random.handle(lever);
    const Wrench wrench = random.wrench();
    EXPECT_NEAR(test::power_w(at_handle(lever, handle, wrench), handle),
                test::power_w(wrench, at_tip(lever, handle)), kRounding);
  }
}

// Held 0.1 m above the pivot, with 0.2 m of the shaft inside.
TEST(TrocarLever, ATipThatIsPushedAsidePushesTheHandleTheOtherWayByTheLeversRatio) {
  const TrocarLever lever{.pivot = Vec3::Zero(), .length_m = 0.3, .least_outside_m = 0.05};
  const Measurement handle{.valid = true, .position = {0, 0, 0.1}};
  const Wrench aside = at_handle(lever, handle, {.force = {1, 0, 0}});
  EXPECT_NEAR(aside.force.x(), -2, kRounding);
  const Wrench along = at_handle(lever, handle, {.force = {0, 0, 3}});
  EXPECT_NEAR(along.force.z(), 3, kRounding);
  const Wrench rolled = at_handle(lever, handle, {.torque = {0, 0, 0.1}});
  EXPECT_NEAR(rolled.torque.z(), 0.1, kRounding);
  EXPECT_NEAR(rolled.force.norm(), 0, kRounding);
}

TEST(TrocarLever, TheHandleOfATipIsWhereTheTipComesFrom) {
  RandomHand random(7);
  for (int i = 0; i < kHands; ++i) {
    const TrocarLever lever = random.lever();
    const Measurement tip = at_tip(lever, random.handle(lever));
    const Measurement again = at_tip(lever, at_handle(lever, tip));
    EXPECT_LT((again.position - tip.position).norm(), kRounding);
    EXPECT_LT((again.linear_velocity - tip.linear_velocity).norm(), kRounding);
    EXPECT_LT((again.angular_velocity - tip.angular_velocity).norm(), 1e-9);
    EXPECT_LT(test::turn_between(again.orientation, tip.orientation).norm(), 1e-7);
  }
}

TEST(TrocarLever, AHandleInThePivotOrTurnedRoundSaysNothingOfATip) {
  const TrocarLever lever{.pivot = Vec3::Zero(), .length_m = 0.3, .least_outside_m = 0.05};
  Measurement handle{.valid = true, .position = {0, 0, 0.06}};
  EXPECT_TRUE(goes_through(lever, handle));
  handle.orientation = Eigen::AngleAxisd(3, Vec3::UnitX());
  EXPECT_FALSE(goes_through(lever, handle));
  handle.orientation = Quat::Identity();
  handle.position.z() = 0.04;
  EXPECT_FALSE(goes_through(lever, handle));
  handle.position.setZero();
  EXPECT_FALSE(goes_through(lever, handle));
}

}  // namespace
}  // namespace omentum::device
