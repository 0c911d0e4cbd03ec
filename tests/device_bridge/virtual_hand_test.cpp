#include "device_bridge/virtual_hand.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omentum::device {
namespace {

// A frictionless elastic wall whose surface is the plane through the press point.
constexpr double kWall_n_m = 500;

Wrench wall_force(const scene::HandSpec& hand, const Vec3& tip) {
  const Vec3 normal(hand.press_normal.data());
  const double depth = (hand.press_point - tip).dot(normal);
  return {.force = normal * kWall_n_m * std::max(depth, 0.0)};
}

// The hand against the wall for `seconds`, the wall answering each pose in the next period.
std::vector<Measurement> press(VirtualHand& device, const scene::HandSpec& hand, double rate_hz,
                               double seconds) {
  std::vector<Measurement> measured;
  for (int i = 0; i < static_cast<int>(seconds * rate_hz); ++i) {
    if (!measured.empty()) device.command(wall_force(hand, measured.back().position));
    measured.push_back(device.measure(0));
  }
  return measured;
}

TEST(VirtualHand, TheSteadyForceIsThatOfTwoSpringsAtEveryRate) {
  const scene::HandSpec hand;
  const double expected_n = hand.depth_m * hand.stiffness_n_m * kWall_n_m / (hand.stiffness_n_m + kWall_n_m);
  for (const double rate_hz : {250.0, 300.0, 1000.0, 2000.0}) {
    VirtualHand device(hand, {}, rate_hz);
    press(device, hand, rate_hz, script_period_s(hand));
    EXPECT_NEAR(device.report()["hold_force_n"].get<double>(), expected_n, 1e-6 * expected_n) << rate_hz;
    EXPECT_DOUBLE_EQ(device.report()["deepest_target_m"].get<double>(), hand.depth_m);
  }
}

TEST(VirtualHand, AGraspersJawsAreDrivenAndTheirTorqueIsReported) {
  const scene::HandSpec hand;
  scene::ToolSpec grasper;
  grasper.shape = "grasper";
  grasper.points = {geometry::Vec3(0, 0, 0)};
  EXPECT_FALSE(VirtualHand(hand, {}, 1000).info().actuated_axes & msg::AXIS_GRIP);
  VirtualHand device(hand, grasper, 1000);
  EXPECT_TRUE(device.info().actuated_axes & msg::AXIS_GRIP);
  for (const double nm : {0.01, -0.03, 0.02}) {
    device.command({.grip_torque = nm});
    device.measure(0);
  }
  EXPECT_EQ(device.report()["peak_grip_torque_nm"], 0.03);
}

TEST(VirtualHand, TheWholePressFeelsTheSameAt300And1000Hz) {
  const scene::HandSpec hand;
  VirtualHand slow(hand, {}, 300), fast(hand, {}, 1000);
  const auto slow_way = press(slow, hand, 300, script_period_s(hand));
  const auto fast_way = press(fast, hand, 1000, script_period_s(hand));
  // the wall's answer is late by about a period: at the top speed of the press that is this much way
  const double late_m = 15.0 / 8 * hand.depth_m / hand.press_s / 300;
  for (std::size_t i = 0; 3 * i + 2 < slow_way.size(); ++i) {
    const Vec3 difference = slow_way[3 * i + 2].position - fast_way[10 * i + 9].position;
    ASSERT_LT(difference.norm(), 2 * late_m) << i;
  }
  EXPECT_NEAR(slow.report()["mean_force_n"].get<double>(), fast.report()["mean_force_n"].get<double>(),
              0.02 * fast.report()["mean_force_n"].get<double>());
}

TEST(VirtualHand, PressesTheButtonWhileItSlidesAndOnlyWhereItCuts) {
  scene::HandSpec hand;
  for (const bool cut : {false, true}) {
    hand.cut = cut;
    VirtualHand device(hand, {}, 100);
    for (int i = 1; i < static_cast<int>(100 * script_period_s(hand)); ++i) {
      const bool slides = script_at(hand, 0.01 * i).phase == Phase::kSlide;
      ASSERT_EQ(device.measure(0).buttons, cut && slides ? msg::BUTTON_CUT : 0u) << i;
    }
  }
}

TEST(VirtualHand, AnUnstableForceIsSeenAsOscillation) {
  // a wall that answers late and is far stiffer than the hand: the simulated hand must not hide it
  const scene::HandSpec hand;
  VirtualHand device(hand, {}, 300);
  std::vector<Measurement> measured{device.measure(0)};
  double top_speed = 0;
  for (int i = 0; i < 300 * 6; ++i) {
    Wrench wrench = wall_force(hand, measured.back().position);
    wrench.force *= 100;
    device.command(wrench);
    measured.push_back(device.measure(0));
    top_speed = std::max(top_speed, measured.back().linear_velocity.norm());
  }
  EXPECT_GT(top_speed, 10 * hand.hover_m / hand.approach_s);
}

TEST(VirtualHand, PauseHoldsTheTargetAndTheScriptGoesOnAfterIt) {
  const scene::HandSpec hand;
  VirtualHand device(hand, {}, 1000);
  press(device, hand, 1000, 2.0);
  device.pause(true);
  press(device, hand, 1000, 1.0);
  const Vec3 held = device.measure(0).position;
  press(device, hand, 1000, 3.0);
  EXPECT_LT((device.measure(0).position - held).norm(), 1e-9);
  device.pause(false);
  press(device, hand, 1000, 1.0);
  EXPECT_GT((device.measure(0).position - held).norm(), 1e-3);
}

TEST(VirtualHand, RestartGlidesBackToTheStart) {
  const scene::HandSpec hand;
  VirtualHand device(hand, {}, 1000);
  const Vec3 start = device.measure(0).position;
  press(device, hand, 1000, 8.0);  // while it slides
  device.restart();
  const double speed_limit = 0.2;  // m/s: 15/8 of 5 cm in one second, and the spring's way out of the wall
  for (const Measurement& m : press(device, hand, 1000, 1.9))
    ASSERT_LT(m.linear_velocity.norm(), speed_limit);
  EXPECT_LT((device.measure(0).position - start).norm(), 1e-4);
}

TEST(VirtualHand, TheShaftPassesThroughTheTrocar) {
  const scene::HandSpec hand;
  scene::ToolSpec tool;
  tool.trocar = scene::Vec3{0.05, -0.1, 0.2};
  VirtualHand device(hand, tool, 1000);
  Quat before = device.measure(0).orientation;
  for (const Measurement& m : press(device, hand, 1000, script_period_s(hand))) {
    const Vec3 shaft = m.orientation * Vec3::UnitZ(), to_pivot = *tool.trocar - m.position;
    ASSERT_LT(shaft.cross(to_pivot.normalized()).norm(), 1e-9);
    ASSERT_GT(shaft.dot(to_pivot), 0);
    // the angular velocity is what turned it here since the last pose
    const Vec3 turn = m.angular_velocity * 1e-3;
    const Quat turned =
        turn.norm() > 0 ? Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * before : before;
    ASSERT_LT(turned.angularDistance(m.orientation), 1e-7);
    before = m.orientation;
  }
}

TEST(VirtualHand, ATrocarTurnsTheShaftAboutThePivotWithoutSpinAndLeavesTheTipToTheHand) {
  const scene::HandSpec hand;
  scene::ToolSpec tool;
  tool.trocar = scene::Vec3{0.05, -0.1, 0.2};
  const Vec3 pivot = *tool.trocar;
  VirtualHand held(hand, tool, 1000), free(hand, {}, 1000);
  const auto held_way = press(held, hand, 1000, script_period_s(hand));
  const auto free_way = press(free, hand, 1000, script_period_s(hand));
  double turned = 0;
  for (std::size_t i = 1; i < held_way.size(); ++i) {
    const Measurement &before = held_way[i - 1], &now = held_way[i];
    ASSERT_EQ(now.position, free_way[i].position) << "insertion is free, the pivot does not push the tip";
    // The least rotation that tilts z by theta onto the shaft turns 1 / cos(theta / 2) times as fast as the
    // shaft at most; one that spun about the shaft would turn faster.
    const Vec3 shaft = now.orientation * Vec3::UnitZ();
    const double half_tilt = 0.5 * std::acos(shaft.z());
    const double lever_m = std::min((pivot - before.position).norm(), (pivot - now.position).norm());
    const double swept = (now.position - before.position).norm() / lever_m;
    const double turn = before.orientation.angularDistance(now.orientation);
    // the tilt changes by `swept` at most meanwhile; below 1e-9 rad there is rounding only
    ASSERT_LE(turn, swept / std::cos(half_tilt + swept) + 1e-9) << i;
    turned += turn;
  }
  EXPECT_GT(turned, 0.1);
}

TEST(VirtualHand, AScopePivotsAboutItsTrocarLevelAndRollsAsItsWaySays) {
  scene::ToolSpec scope;
  scope.trocar = scene::Vec3{0.05, -0.2, 0.2};
  scope.scope.emplace();
  scene::HandSpec hand;
  hand.way = {{.to = Vec3(0, 0, 0.1), .seconds = 1},
              {.to = Vec3(0.03, 0.01, 0.08), .seconds = 1, .roll_rad = 0.5}};
  hand.press_point = hand.way[0].to;
  VirtualHand device(hand, scope, 1000);
  double most_rolled = 0;
  for (const Measurement& m : press(device, hand, 1000, script_period_s(hand))) {
    const Vec3 shaft = m.orientation * Vec3::UnitZ();
    ASSERT_LT(shaft.cross(*scope.trocar - m.position).norm(), 1e-9) << "the shaft passes the pivot";
    // sin of the roll: how far the x axis leans out of the level, where the shaft itself is not upright
    const double level = std::hypot(shaft.x(), shaft.y());
    most_rolled = std::max(most_rolled, std::asin((m.orientation * Vec3::UnitX()).z() / level));
  }
  EXPECT_NEAR(most_rolled, 0.5, 0.01);
  EXPECT_NEAR((device.measure(0).orientation * Vec3::UnitX()).z(), 0, 0.01) << "level again";
}

TEST(VirtualHand, WithoutATrocarTheShaftStandsOnTheSurface) {
  scene::HandSpec hand;
  hand.press_normal = {0, 0.6, 0.8};
  VirtualHand device(hand, {}, 1000);
  EXPECT_LT((device.measure(0).orientation * Vec3::UnitZ() - Vec3(0, 0.6, 0.8)).norm(), 1e-12);
}

}  // namespace
}  // namespace omentum::device
