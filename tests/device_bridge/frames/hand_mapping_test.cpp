#include "device_bridge/frames/hand_mapping.h"

#include "tests/device_bridge/frames/random_hand.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace omentum::device {
namespace {

using test::RandomHand;

constexpr std::uint32_t kClutch = 1, kEnable = 2;
constexpr double kTick_s = 1e-3;
constexpr int kTakesHold = 210;  // ticks after which a force is felt whole

MappingSpec any_spec(RandomHand& random) {
  MappingSpec spec;
  spec.base = random.base();
  spec.force_scale = random.number(0.1, 2);
  if (random.number(0, 1) > 0.3) spec.lever = random.lever();
  spec.clutch_button = kClutch;
  return spec;
}

// Somewhere where the mapping has a tool.
Measurement any_hand(const MappingSpec& spec, RandomHand& random) {
  if (!spec.lever) return random.hand(Vec3::Zero());
  return to_base(spec.base, random.handle(*spec.lever));
}

void take_hold(HandMapping& mapping, const Measurement& hand) {
  for (int i = 0; i < kTakesHold; ++i) {
    mapping.to_tool(hand);
    mapping.to_hand({}, kTick_s);
  }
}

TEST(HandMapping, TheHandsPowerIsTheToolsTimesTheForceScale) {
  RandomHand random(11);
  for (int i = 0; i < 100; ++i) {
    const MappingSpec spec = any_spec(random);
    HandMapping mapping(spec);
    const Measurement hand = any_hand(spec, random);
    take_hold(mapping, hand);
    const Measurement tool = mapping.to_tool(hand);
    const Wrench at_tool = random.wrench(), felt = mapping.to_hand(at_tool, kTick_s);
    EXPECT_NEAR(test::power_w(felt, hand), spec.force_scale * test::power_w(at_tool, tool), 1e-11);
    EXPECT_NEAR(felt.grip_torque, spec.force_scale * at_tool.grip_torque, 1e-15);
  }
}

TEST(HandMapping, AfterAClutchItStillIs) {
  RandomHand random(12);
  for (int i = 0; i < 100; ++i) {
    const MappingSpec spec{.base = random.base(), .clutch_button = kClutch};
    HandMapping mapping(spec);
    Measurement hand = random.hand(Vec3::Zero());
    hand.buttons = 1U << kClutch;
    mapping.to_tool(hand);
    const Measurement elsewhere = random.hand(Vec3::UnitX());
    take_hold(mapping, elsewhere);
    const Measurement tool = mapping.to_tool(elsewhere);
    const Wrench at_tool = random.wrench();
    EXPECT_NEAR(test::power_w(mapping.to_hand(at_tool, kTick_s), elsewhere), test::power_w(at_tool, tool),
                1e-11);
  }
}

TEST(HandMapping, WhatNobodyConfiguredChangesNothing) {
  RandomHand random(13);
  HandMapping mapping;
  const Measurement hand = random.hand(Vec3::Zero()), tool = mapping.to_tool(hand);
  EXPECT_EQ(tool.position, hand.position);
  EXPECT_EQ(tool.orientation.coeffs(), hand.orientation.coeffs());
  const Wrench wrench = random.wrench();
  EXPECT_EQ(mapping.to_hand(wrench, 0).force, wrench.force);
  EXPECT_EQ(mapping.share(), 1);
}

// A hand presses, clutches, goes back, and presses on, 1000 times a second.
TEST(HandMapping, AClutchMakesNoJumpInPoseOrForce) {
  const MappingSpec spec{.base = {.scale = 0.5}, .clutch_button = kClutch};
  HandMapping mapping(spec);
  Measurement hand{.valid = true};
  take_hold(mapping, hand);
  Measurement before = mapping.to_tool(hand);
  Vec3 felt_before = mapping.to_hand({.force = Vec3::UnitZ()}, kTick_s).force;
  double largest_step_m = 0, largest_rise_n = 0, largest_fall_n = 0;
  constexpr double kHandStep_m = 1e-4;
  for (int i = 0; i < 900; ++i) {
    const bool clutched = i >= 300 && i < 600;
    hand.buttons = clutched ? 1U << kClutch : 0;
    hand.position.z() += clutched ? 2 * kHandStep_m : -kHandStep_m;
    const Vec3 felt = mapping.to_hand({.force = 4 * Vec3::UnitZ()}, kTick_s).force;
    const Measurement tool = mapping.to_tool(hand);
    largest_step_m = std::max(largest_step_m, (tool.position - before.position).norm());
    if (i > 0) {
      largest_rise_n = std::max(largest_rise_n, (felt - felt_before).z());
      largest_fall_n = std::max(largest_fall_n, (felt_before - felt).z());
    }
    if (i == 599) {
      EXPECT_EQ(felt.norm(), 0);
    }
    before = tool, felt_before = felt;
  }
  // 300 steps down, one of two up until the clutch was seen, 299 down after it was seen to be let go
  EXPECT_NEAR(before.position.z(), -0.5 * (300 - 2 + 299) * kHandStep_m, 1e-12);
  EXPECT_LE(largest_step_m, 0.5 * 2 * kHandStep_m + 1e-15);
  EXPECT_NEAR(largest_rise_n, 2 * kTick_s / Engagement::kTakeHold_s, 1e-9);
  EXPECT_NEAR(largest_fall_n, 2 * kTick_s / Engagement::kLetGo_s, 1e-9);
}

TEST(HandMapping, WhoLetsGoOfTheEnableButtonLetsGoOfTheTool) {
  HandMapping mapping({.enable_button = kEnable});
  Measurement hand{.valid = true, .buttons = 1U << kEnable};
  take_hold(mapping, hand);
  EXPECT_TRUE(mapping.to_tool(hand).valid);
  EXPECT_EQ(mapping.to_hand({.force = Vec3::UnitZ()}, kTick_s).force.z(), 1);
  hand.buttons = 0;
  EXPECT_FALSE(mapping.to_tool(hand).valid);
  for (int i = 0; i < 21; ++i) mapping.to_hand({.force = Vec3::UnitZ()}, kTick_s);
  EXPECT_EQ(mapping.to_hand({.force = Vec3::UnitZ()}, kTick_s).force.z(), 0);
}

TEST(HandMapping, AHandleTooNearToThePivotHoldsNoTool) {
  HandMapping mapping({.lever = TrocarLever{.pivot = Vec3::Zero(), .length_m = 0.3, .least_outside_m = 0.1}});
  Measurement hand{.valid = true, .position = {0, 0, 0.15}};
  take_hold(mapping, hand);
  const double before = mapping.to_hand({.force = Vec3::UnitX()}, kTick_s).force.x();
  EXPECT_NEAR(before, -1, 1e-12);
  hand.position.z() = 0.09;
  EXPECT_FALSE(mapping.to_tool(hand).valid);
  EXPECT_TRUE(mapping.off_trocar());
  const double felt = mapping.to_hand({.force = Vec3::UnitX()}, kTick_s).force.x();
  EXPECT_NEAR(felt, -1 + kTick_s / Engagement::kLetGo_s, 1e-12);  // it fades from where the lever was
}

// Round a closed way the tool comes back to where it was in a field that has a potential: so does the hand.
TEST(HandMapping, AClosedWayInElasticTissueCostsTheHandNothing) {
  const TrocarLever lever{.pivot = {0, 0, 0.1}, .length_m = 0.3, .least_outside_m = 0.05};
  const MappingSpec spec{.base = {.q_WB = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitY())), .scale = 0.6},
                         .force_scale = 1.5,
                         .lever = lever};
  HandMapping mapping(spec);
  const Vec3 middle =
      to_base(spec.base, at_handle(lever, Measurement{.position = {0.01, 0, -0.08}})).position;
  const auto hand_at = [&](double angle) {
    const Vec3 aside(0.03 * std::cos(angle), 0.02 * std::sin(angle), 0.02 * std::sin(2 * angle));
    const Measurement handle = to_scene(spec.base, Measurement{.valid = true, .position = middle + aside});
    const Vec3 shaft = handle.position - lever.pivot;
    return to_base(spec.base, Measurement{.valid = true,
                                          .position = handle.position,
                                          .orientation = Quat::FromTwoVectors(Vec3::UnitZ(), shaft)});
  };
  const auto tissue = [](const Vec3& tip) { return Wrench{.force = -500 * (tip - Vec3(0, 0, -0.2))}; };
  take_hold(mapping, hand_at(0));
  constexpr int kSteps = 4000;
  double work_j = 0, went_j = 0;
  Measurement hand = hand_at(0);
  Vec3 felt = mapping.to_hand(tissue(mapping.to_tool(hand).position), kTick_s).force;
  for (int i = 1; i <= kSteps; ++i) {
    const Measurement next = hand_at(2 * M_PI * i / kSteps);
    const Vec3 felt_next = mapping.to_hand(tissue(mapping.to_tool(next).position), kTick_s).force;
    const double step_j = (felt + felt_next).dot(next.position - hand.position) / 2;
    work_j += step_j, went_j += std::abs(step_j);
    hand = next, felt = felt_next;
  }
  EXPECT_GT(went_j, 0.1);
  EXPECT_LT(std::abs(work_j), 1e-6 * went_j);  // of the trapezoidal rule over 4000 steps
}

TEST(HandMapping, ItDescribesTheDeviceAsTheToolHasIt) {
  msg::DeviceInfo info;
  info.max_force_n = 8;
  info.max_torque_nm = 0.5;
  info.max_stiffness_n_m = 2000;
  info.damping_n_s_m = 2;
  info.workspace_min = {-0.1, -0.2, 0};
  info.workspace_max = {0.1, 0.2, 0.3};
  const HandMapping fine(
      {.base = {.q_WB = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ())), .p_WB = {1, 0, 0}, .scale = 0.5}});
  const msg::DeviceInfo tool = fine.describe(info);
  EXPECT_DOUBLE_EQ(tool.max_force_n, 16);
  EXPECT_DOUBLE_EQ(tool.max_torque_nm, 0.5);
  EXPECT_DOUBLE_EQ(tool.max_stiffness_n_m, 8000);
  EXPECT_DOUBLE_EQ(tool.damping_n_s_m, 8);
  EXPECT_NEAR(tool.workspace_min.x, 0.9, 1e-12);
  EXPECT_NEAR(tool.workspace_max.y, 0.05, 1e-12);
  EXPECT_NEAR(tool.workspace_max.z, 0.15, 1e-12);
  const HandMapping by_micrometres({.base = {.scale = 1e-3}});
  EXPECT_DOUBLE_EQ(by_micrometres.describe(info).max_force_n, 1000);
  EXPECT_DOUBLE_EQ(by_micrometres.describe(info).max_stiffness_n_m, 1e6);
  const HandMapping levered({.lever = TrocarLever{.length_m = 0.3, .least_outside_m = 0.1}});
  EXPECT_DOUBLE_EQ(levered.describe(info).max_force_n, 4);
  EXPECT_DOUBLE_EQ(levered.describe(info).max_stiffness_n_m, 500);
}

// Less than 1 N/m is refused by haptic_node, and 1 N/m at the tool would be 90 kN/m in this hand.
TEST(HandMapping, ALeverThatLeavesNothingOfTheDevicesStiffnessIsRefused) {
  msg::DeviceInfo info;
  info.tool = 3;
  info.max_stiffness_n_m = 2000;
  const HandMapping at_pivot({.lever = TrocarLever{.length_m = 0.3, .least_outside_m = 0.001}});
  try {
    static_cast<void>(at_pivot.describe(info));
    ADD_FAILURE() << "took it";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("tool 3: "));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("least_outside_m"));
  }
  info.max_stiffness_n_m = 0.5;  // the device's own word is haptic_node's to refuse
  EXPECT_LT(at_pivot.describe(info).max_stiffness_n_m, 1e-4);
}

}  // namespace
}  // namespace omentum::device
