// A tool's channel with a mapping: what the wire says is the tool's, what guards the hand is the hand's.
#include "device_bridge/tool_channel.h"
#include "device_bridge/virtual_hand.h"
#include "tests/device_bridge/frames/random_hand.h"
#include "tests/support/heap_count.h"
#include "tests/support/milliseconds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace omentum::device {
namespace {

using omentum::test::kMs;

struct StagedDevice : Device {
  msg::DeviceInfo info() const override {
    msg::DeviceInfo info;
    info.max_force_n = 8;
    info.max_torque_nm = 0.5;
    return info;
  }
  void command(const Wrench& wrench) noexcept override { commanded = wrench; }
  Measurement measure(std::int64_t now_ns) noexcept override {
    hand.measured_ns = now_ns;
    return hand;
  }
  bool simulates() const noexcept override { return true; }

  Measurement hand{.valid = true};
  Wrench commanded;
};

// The device, and a tissue that answers each pose.
struct MappedChannel {
  explicit MappedChannel(const MappingSpec& spec) : channel(std::unique_ptr<Device>(device), faults, spec) {}

  const msg::ToolPose& tick() {
    now_ns += kMs;
    pose = channel.tick(now_ns);
    return pose;
  }
  void answer(const Vec3& force) {
    msg::ToolForce answer;
    answer.seq = ++answers;
    answer.echo_seq = pose.seq;
    answer.echo_stamp_ns = pose.stamp_ns;
    answer.force = to_message(force);
    answer.valid_for_s = 0.005;
    channel.receive(answer, now_ns);
  }

  runtime::FaultList faults;
  StagedDevice* device = new StagedDevice;
  ToolChannel channel;
  msg::ToolPose pose;
  std::int64_t now_ns = 0;
  std::uint64_t answers = 0;
};

TEST(MappedChannel, WhatIsToldIsTheToolsAndWhatIsExertedTheHands) {
  MappedChannel staged({.base = {.q_WB = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ())), .scale = 0.5}});
  EXPECT_DOUBLE_EQ(staged.channel.info().max_force_n, 16);
  staged.device->hand.position = {0.1, 0, 0};
  for (int i = 0; i < 500; ++i) {
    staged.tick();
    staged.answer({0, 4, 0});
  }
  EXPECT_NEAR(staged.pose.position.y, 0.05, 1e-12);
  EXPECT_NEAR(staged.device->commanded.force.x(), 2, 1e-9);
  EXPECT_EQ(staged.faults.lines().size(), 0U);
}

// The tank is the hand's: what it is given over a scripted press of a spring of the tool's side.
TEST(MappedChannel, TheAccountIsOfWhatTheHandFeltAndHowFarItWent) {
  MappedChannel staged({.base = {.scale = 0.25}, .force_scale = 2});
  double work_j = 0;
  Vec3 before = staged.device->hand.position;
  for (int i = 0; i < 3000; ++i) {
    staged.device->hand.position.z() = -0.02 * (1 - std::cos(i * 2e-3 * M_PI));
    staged.tick();
    work_j += staged.device->commanded.force.dot(staged.device->hand.position - before);
    before = staged.device->hand.position;
    staged.answer({0, 0, std::max(0.0, -400 * staged.pose.position.z)});
  }
  EXPECT_NEAR(staged.channel.energy_j(), work_j, 1e-12);
  EXPECT_LT(staged.channel.most_energy_j(), node::EnergyTank::kBound_j);
}

// A force on the tool in a world where the tool only waits would feed a hand that goes its own way.
TEST(MappedChannel, AHandThatClutchesInAPressIsFedByNothing) {
  constexpr std::uint32_t kClutch = 4;
  MappedChannel staged({.clutch_button = kClutch});
  double largest_rise_n = 0, felt_n = 0;
  for (int i = 0; i < 4000; ++i) {
    // down 3 cm while it holds the tool, up again while it does not, and once more
    const int phase = i % 1000;
    staged.device->hand.buttons = phase >= 500 ? 1U << kClutch : 0;
    staged.device->hand.position.z() = -0.015 * (1 - std::cos(phase * 2e-3 * M_PI));
    staged.tick();
    const double now_n = staged.device->commanded.force.norm();
    largest_rise_n = std::max(largest_rise_n, now_n - felt_n);
    felt_n = now_n;
    staged.answer({0, 0, std::max(0.0, -40 * staged.pose.position.z)});
    if (phase == 700) {
      EXPECT_EQ(staged.device->commanded.force.norm(), 0);
      EXPECT_EQ(staged.tick().answer_seq, 0U);
    }
  }
  EXPECT_NEAR(staged.pose.position.z, -4 * 0.03, 1e-3);  // it went on each time
  EXPECT_LT(staged.channel.energy_j(), 0);               // what the tissue holds came from the hand
  EXPECT_LT(staged.channel.most_energy_j(), node::EnergyTank::kBound_j);
  EXPECT_LT(largest_rise_n, 0.1);
}

TEST(MappedChannel, AHandleOffItsTrocarIsAFaultAndADeadMansButtonIsNone) {
  MappedChannel off({.lever = TrocarLever{.length_m = 0.3, .least_outside_m = 0.1}});
  EXPECT_FALSE(off.tick().valid);
  ASSERT_EQ(off.faults.lines().size(), 1U);
  MappedChannel disabled({.enable_button = 1});
  EXPECT_FALSE(disabled.tick().valid);
  EXPECT_EQ(disabled.faults.lines().size(), 0U);
}

TEST(MappedChannel, ItAllocatesNothing) {
  MappedChannel staged({.base = {.scale = 0.5},
                        .lever = TrocarLever{.length_m = 0.3, .least_outside_m = 0.1},
                        .clutch_button = 1,
                        .enable_button = 2});
  staged.device->hand.position.z() = 0.4;
  staged.device->hand.buttons = 4;
  staged.tick();
  const std::size_t before = omentum::test::heap_allocations();
  for (int i = 0; i < 100; ++i) {
    staged.tick();
    staged.answer(Vec3::UnitZ());
  }
  EXPECT_EQ(omentum::test::heap_allocations(), before);
}

// The script is the tip's; the hand that follows it is at the handle.
TEST(MappedChannel, ASimulatedHandAtItsHandlePlaysTheScriptWithTheTip) {
  scene::HandSpec hand;
  hand.press_point = {0.02, 0, 0};
  scene::ToolSpec tool;
  tool.trocar = Vec3(0, -0.1, 0.15);
  const MappingSpec spec{.base = {.q_WB = Quat(Eigen::AngleAxisd(0.5, Vec3::UnitX())), .scale = 0.8},
                         .lever = TrocarLever{*tool.trocar, 0.3, 0.1}};
  VirtualHand free(hand, tool, 1000), levered(hand, tool, 1000, spec);
  HandMapping mapping(spec);
  for (int i = 0; i < 2000; ++i) {
    const Measurement tip = free.measure(i * kMs), levered_tip = mapping.to_tool(levered.measure(i * kMs));
    ASSERT_TRUE(levered_tip.valid);
    // both hands lag behind the script by less than this, each in its own way
    ASSERT_LT((tip.position - levered_tip.position).norm(), 2e-3) << i;
    ASSERT_LT(tip.orientation.angularDistance(levered_tip.orientation), 0.02) << i;
  }
}

}  // namespace
}  // namespace omentum::device
