#include "device_bridge/force_hold.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::device {
namespace {

constexpr double kMaxForce_n = 10, kMaxTorque_nm = 0.5;
constexpr std::int64_t kMs = 1'000'000;

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

TEST(ForceHold, HoldsAnAnswerWhileItIsValidThenLetsItDecayToZero) {
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  ASSERT_TRUE(hold.take(answer({0, 0, 2}), 100 * kMs));
  EXPECT_EQ(hold.at(100 * kMs).force, Vec3(0, 0, 2));
  EXPECT_EQ(hold.at(105 * kMs).force, Vec3(0, 0, 2));
  double last = 2;
  for (int ms = 106; ms < 125; ++ms) {
    const double now = hold.at(ms * kMs).force.z();
    EXPECT_LT(now, last);
    EXPECT_GT(now, 0);
    last = now;
  }
  EXPECT_EQ(hold.at(125 * kMs).force.norm(), 0);
  EXPECT_EQ(hold.at(9000 * kMs).torque.norm(), 0);
  EXPECT_EQ(hold.expired(), 1u);
}

TEST(ForceHold, ANewAnswerEndsTheDecay) {
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  ASSERT_TRUE(hold.take(answer({0, 0, 2}), 0));
  (void)hold.at(15 * kMs);
  ASSERT_TRUE(hold.take(answer({0, 0, 3}), 16 * kMs));
  EXPECT_EQ(hold.at(17 * kMs).force.z(), 3);
}

TEST(ForceHold, AnAnswerThatIsNotFiniteIsRefusedAndTheOldOneKept) {
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  ASSERT_TRUE(hold.take(answer({1, 0, 0}), 0));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(hold.take(answer({0, bad, 0}), 1));
    msg::ToolForce grip = answer({0, 0, 0});
    grip.grip_torque = bad;
    EXPECT_FALSE(hold.take(grip, 1));
  }
  EXPECT_EQ(hold.at(2).force, Vec3(1, 0, 0));
}

TEST(ForceHold, LimitsAreTheDevicesAndKeepTheDirection) {
  ForceHold hold(kMaxForce_n, kMaxTorque_nm);
  ASSERT_TRUE(hold.take(answer({300, -400, 0}), 0));
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
