#include "device_bridge/hand_script.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omentum::device {
namespace {

constexpr double kStep_s = 1e-3;
constexpr int kRounds = 2;

// The defaults, a light press, and phases of no length.
std::vector<scene::HandSpec> hands() {
  scene::HandSpec light, abrupt;
  light.depth_m = 0;
  light.hover_m = 0.01;
  abrupt.start_s = 0;
  abrupt.hold_s = 0;
  return {scene::HandSpec{}, light, abrupt};
}

TEST(HandScript, PositionAndVelocityAreContinuousFromRoundToRound) {
  for (const auto& hand : hands()) {
    // a minimum-jerk move peaks at 15/8 of its mean speed and 5.78 way / duration^2 (10 / sqrt(3))
    const double way = hand.hover_m + hand.depth_m + hand.slide_m;
    const double shortest_s = 0.5 * std::min({hand.approach_s, hand.press_s, hand.slide_s, hand.release_s});
    const double top_speed = 15.0 / 8 * way / shortest_s;
    const double top_acceleration = 5.78 * way / (shortest_s * shortest_s);
    ScriptPoint before = script_at(hand, 0);
    for (double t = kStep_s; t < kRounds * script_period_s(hand); t += kStep_s) {
      const ScriptPoint now = script_at(hand, t);
      ASSERT_LE(std::abs(now.height_m - before.height_m), top_speed * kStep_s) << t;
      ASSERT_LE(std::abs(now.slide_m - before.slide_m), top_speed * kStep_s) << t;
      ASSERT_LE(std::abs(now.height_rate_m_s - before.height_rate_m_s), top_acceleration * kStep_s) << t;
      ASSERT_LE(std::abs(now.slide_rate_m_s - before.slide_rate_m_s), top_acceleration * kStep_s) << t;
      // the velocity is the position's: central difference, error of third order in the step
      const double difference = (now.height_m - before.height_m) / kStep_s;
      ASSERT_NEAR(difference, 0.5 * (now.height_rate_m_s + before.height_rate_m_s),
                  top_acceleration * kStep_s)
          << t;
      before = now;
    }
  }
}

TEST(HandScript, GoesFromHoverToDepthAndSlides) {
  const scene::HandSpec hand;
  double lowest = 1, highest = -1, farthest = 0;
  for (double t = 0; t < script_period_s(hand); t += kStep_s) {
    const ScriptPoint now = script_at(hand, t);
    lowest = std::min(lowest, now.height_m);
    highest = std::max(highest, now.height_m);
    farthest = std::max(farthest, now.slide_m);
  }
  EXPECT_DOUBLE_EQ(lowest, -hand.depth_m);
  EXPECT_DOUBLE_EQ(highest, hand.hover_m);
  EXPECT_NEAR(farthest, hand.slide_m, 1e-9);
}

TEST(HandScript, ComesBackAlongTheSlideOnlyAboveTheSurface) {
  const scene::HandSpec hand;
  for (double t = 0; t < script_period_s(hand); t += kStep_s) {
    const ScriptPoint now = script_at(hand, t);
    ASSERT_TRUE(now.slide_rate_m_s >= 0 || now.height_m > 0) << t;
  }
}

TEST(HandScript, DepthZeroNeverGoesBelowTheSurface) {
  scene::HandSpec hand;
  hand.depth_m = 0;
  for (double t = 0; t < script_period_s(hand); t += kStep_s) ASSERT_GE(script_at(hand, t).height_m, 0);
}

TEST(HandScript, EveryRoundIsTheSame) {
  const scene::HandSpec hand;
  for (double t = 0.5 * kStep_s; t < script_period_s(hand); t += 0.1) {
    const ScriptPoint first = script_at(hand, t), tenth = script_at(hand, t + 9 * script_period_s(hand));
    EXPECT_EQ(first.phase, tenth.phase) << t;
    EXPECT_NEAR(first.height_m, tenth.height_m, 1e-12);
  }
}

TEST(HandScript, TargetLiesOnTheNormalAndTheSlideDirection) {
  scene::HandSpec hand;
  hand.press_point = {1, 2, 3};
  hand.press_normal = {0, 1, 0};
  hand.slide_direction = {0, 0, 1};
  const Motion target =
      target_of(hand, {.height_m = 0.5, .height_rate_m_s = -1, .slide_m = 0.25, .slide_rate_m_s = 2});
  EXPECT_EQ(target.position, Vec3(1, 2.5, 3.25));
  EXPECT_EQ(target.velocity, Vec3(0, -1, 2));
}

}  // namespace
}  // namespace omentum::device
