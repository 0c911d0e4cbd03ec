#include "device_bridge/hand_way.h"

#include "device_bridge/virtual_hand.h"

#include <gtest/gtest.h>

namespace omentum::device {
namespace {

/// Goes to a place, closes its jaws, lifts, opens them, and comes back.
scene::HandSpec grasping_hand() {
  scene::HandSpec hand;
  hand.way = {{Vec3(0, 0, 0.1), 2, 0.5},
              {Vec3(0.05, 0, 0), 1, 0.5},
              {Vec3(0.05, 0, 0), 0.5, 0},
              {Vec3(0.05, 0.02, 0.08), 1.5, 0},
              {Vec3(0.05, 0.02, 0.08), 0.5, 0.5}};
  hand.press_point = hand.way.front().to;
  return hand;
}

TEST(HandWay, PassesEveryWaypointInItsTimeAndBeginsAgain) {
  const scene::HandSpec hand = grasping_hand();
  EXPECT_DOUBLE_EQ(script_period_s(hand), 5.5);
  double t = 0;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < hand.way.size(); ++i) {
      if (round > 0 || i > 0) t += hand.way[i].seconds;
      const ScriptPoint point = script_at(hand, t);
      EXPECT_LT((target_of(hand, point).position - hand.way[i].to).norm(), 1e-12) << i;
      EXPECT_LT(target_of(hand, point).velocity.norm(), 1e-9) << i << ": it stands still there";
      EXPECT_NEAR(point.grip_rad, hand.way[i].grip_rad, 1e-12) << i;
    }
  }
}

TEST(HandWay, MovesWithoutAJumpByItsOwnVelocity) {
  const scene::HandSpec hand = grasping_hand();
  constexpr double kStep_s = 1e-4;
  for (double t = 0; t < 12; t += 0.01) {
    const Motion a = target_of(hand, script_at(hand, t)), b = target_of(hand, script_at(hand, t + kStep_s));
    EXPECT_LT(((b.position - a.position) / kStep_s - (a.velocity + b.velocity) / 2).norm(), 1e-3) << t;
    EXPECT_LT(std::abs(script_at(hand, t + kStep_s).grip_rad - script_at(hand, t).grip_rad), 1e-3);
  }
}

TEST(HandWay, AHoldIsWhatLiesBetweenWaypointsAtOnePlace) {
  const scene::HandSpec hand = grasping_hand();
  EXPECT_EQ(script_at(hand, 0.5).phase, Phase::kSlide);
  EXPECT_EQ(script_at(hand, 1.2).phase, Phase::kHold);
  EXPECT_NEAR(script_at(hand, 1.25).phase_share, 0.5, 1e-12);
}

TEST(HandWay, OneWaypointIsAHandThatStaysThere) {
  scene::HandSpec hand;
  hand.way = {{Vec3(0, 0, 0.1), 1, 0.2}};
  for (const double t : {0.0, 0.5, 3.3}) {
    EXPECT_EQ(target_of(hand, script_at(hand, t)).position, Vec3(0, 0, 0.1));
    EXPECT_EQ(script_at(hand, t).grip_rad, 0.2);
  }
}

TEST(HandWay, AHandThatCutsPressesItsButtonWhileItMoves) {
  scene::HandSpec hand = grasping_hand();
  hand.cut = true;
  VirtualHand device(hand, {}, 1000);
  int pressed = 0;
  for (int tick = 1; tick <= 5500; ++tick) {
    const bool cuts = device.measure(0).buttons != 0;
    const bool holds = (tick > 1002 && tick < 1498) || (tick > 3002 && tick < 3498);
    EXPECT_FALSE(cuts && holds) << tick;
    pressed += cuts;
  }
  EXPECT_NEAR(pressed, 4500, 5) << "as long as its moves take";
}

TEST(HandWay, AVirtualHandMeasuresItsJaws) {
  VirtualHand hand(grasping_hand(), {}, 1000);
  for (int tick = 0; tick < 900; ++tick) EXPECT_GT(hand.measure(0).grip, 0.4);
  double closed = 1;
  for (int tick = 0; tick < 1500; ++tick) closed = std::min(closed, hand.measure(0).grip);
  EXPECT_LT(closed, 1e-6);
}

}  // namespace
}  // namespace omentum::device
