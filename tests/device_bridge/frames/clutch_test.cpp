#include "device_bridge/frames/clutch.h"

#include "tests/device_bridge/frames/random_hand.h"

#include <gtest/gtest.h>

namespace omentum::device {
namespace {

constexpr double kSame = 1e-12;

double apart(const Measurement& a, const Measurement& b) {
  return (a.position - b.position).norm() + a.orientation.angularDistance(b.orientation);
}

TEST(Clutch, AToolThatNobodyClutchedFollowsTheHand) {
  test::RandomHand random(1);
  Clutch clutch;
  for (int i = 0; i < 20; ++i) {
    const Measurement hand = random.hand(Vec3::Zero());
    EXPECT_LT(apart(clutch.follow(hand, false), hand), 1e-7);
  }
}

TEST(Clutch, TheToolWaitsWhereItWasWhileTheHandMoves) {
  test::RandomHand random(2);
  Clutch clutch;
  const Measurement tool = clutch.follow(random.hand(Vec3::Zero()), true);
  for (int i = 0; i < 20; ++i) {
    const Measurement waiting = clutch.follow(random.hand(Vec3::UnitX()), true);
    EXPECT_LT(apart(waiting, tool), kSame);
    EXPECT_EQ(waiting.linear_velocity.norm() + waiting.angular_velocity.norm(), 0);
  }
}

TEST(Clutch, LetGoAnywhereItGoesOnWithoutAJump) {
  test::RandomHand random(3);
  Clutch clutch;
  for (int i = 0; i < 20; ++i) {
    const Measurement tool = clutch.follow(random.hand(Vec3::Zero()), true);
    const Measurement hand = random.hand(Vec3::UnitX());
    EXPECT_LT((clutch.follow(hand, false).position - tool.position).norm(), kSame);
    EXPECT_LT(clutch.follow(hand, false).orientation.angularDistance(tool.orientation), 1e-7);
  }
}

TEST(Clutch, AfterItTheToolMovesAndTurnsAsTheHandDoes) {
  test::RandomHand random(4);
  Clutch clutch;
  clutch.follow(random.hand(Vec3::Zero()), true);
  const Measurement hand = random.hand(Vec3::UnitX()), later = test::moved(hand, 0.1);
  const Measurement tool = clutch.follow(hand, false), tool_later = clutch.follow(later, false);
  EXPECT_LT((tool_later.position - tool.position - (later.position - hand.position)).norm(), kSame);
  const Vec3 hand_turn = test::turn_between(hand.orientation, later.orientation);
  EXPECT_LT((test::turn_between(tool.orientation, tool_later.orientation) - hand_turn).norm(), 1e-7);
  EXPECT_EQ((tool.linear_velocity - hand.linear_velocity).norm(), 0);
}

TEST(Clutch, JawsAndButtonsStayTheHands) {
  Clutch clutch;
  Measurement hand;
  clutch.follow(hand, true);
  hand.grip = 0.3;
  hand.buttons = 5;
  EXPECT_EQ(clutch.follow(hand, true).grip, 0.3);
  EXPECT_EQ(clutch.follow(hand, true).buttons, 5U);
}

}  // namespace
}  // namespace omentum::device
