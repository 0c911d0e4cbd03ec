#include "device_bridge/jaw_hand.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::device {
namespace {

constexpr double kJawStep_s = 1e-3;

TEST(JawHand, ClosesAndOpensAtItsRateAndStopsAtBothEnds) {
  double grip = kJawsOpen_rad;
  for (int i = 1; i <= 1000; ++i) {
    grip = step_jaws(grip, JawWish::kClose, 0, kJawStep_s);
    EXPECT_NEAR(grip, std::max(0.0, kJawsOpen_rad - kJawRate_rad_s * i * kJawStep_s), 1e-12);
  }
  for (int i = 0; i < 1000; ++i) grip = step_jaws(grip, JawWish::kOpen, 0, kJawStep_s);
  EXPECT_DOUBLE_EQ(grip, kJawsOpen_rad);
}

TEST(JawHand, SqueezesTissueWithNoMoreThanItsTorqueAndDoesNotTremble) {
  for (const double stiffness_nm_rad : {0.3, 1.0, 5.0}) {
    double grip = 0.4, torque = 0, before = 0;
    for (int i = 0; i < 3000; ++i) {
      const double next = step_jaws(grip, JawWish::kClose, before, kJawStep_s);
      EXPECT_LE(next, grip + 1e-12) << "it only closes";
      grip = next;
      before = torque;  // an answer comes two periods later
      torque = stiffness_nm_rad * std::max(0.0, 0.4 - grip);
    }
    EXPECT_NEAR(torque, std::min(kSqueeze_nm, 0.4 * stiffness_nm_rad), 1e-3 * kSqueeze_nm)
        << stiffness_nm_rad;
  }
}

TEST(JawHand, JawsThatStayGiveWayAboveTheirTorqueOnly) {
  EXPECT_EQ(step_jaws(0.1, JawWish::kStay, 0.9 * kSqueeze_nm, kJawStep_s), 0.1);
  EXPECT_EQ(step_jaws(0.1, JawWish::kStay, -kSqueeze_nm, kJawStep_s), 0.1);
  EXPECT_GT(step_jaws(0.1, JawWish::kStay, 1.5 * kSqueeze_nm, kJawStep_s), 0.1);
}

TEST(JawHand, JawsThatAScriptOpenedFartherDoNotJump) {
  EXPECT_EQ(step_jaws(0.9, JawWish::kStay, 0, kJawStep_s), 0.9);
  EXPECT_EQ(step_jaws(0.9, JawWish::kOpen, 0, kJawStep_s), 0.9);
  EXPECT_NEAR(step_jaws(0.9, JawWish::kClose, 0, kJawStep_s), 0.9 - kJawRate_rad_s * kJawStep_s, 1e-12);
}

}  // namespace
}  // namespace omentum::device
