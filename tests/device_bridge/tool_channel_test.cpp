#include "device_bridge/tool_channel.h"

#include "device_bridge/virtual_hand.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace omentum::device {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// A device whose measurement the test sets and whose command it sees.
struct FakeDevice : Device {
  msg::DeviceInfo info() const override {
    msg::DeviceInfo info;
    info.tool = 3;
    info.max_force_n = 5;
    info.max_torque_nm = 1;
    return info;
  }
  void command(const Wrench& wrench) noexcept override { commanded = wrench; }
  Measurement measure() noexcept override { return measurement; }

  Measurement measurement{.valid = true};
  Wrench commanded;
};

struct ToolChannelTest : ::testing::Test {
  runtime::FaultList faults;
  FakeDevice* device = new FakeDevice;
  ToolChannel channel{std::unique_ptr<Device>(device), faults};

  void answer(const Vec3& force, std::int64_t now_ns) {
    msg::ToolForce answer;
    answer.tool = 3;
    answer.force = to_message(force);
    answer.valid_for_s = 0.005;
    channel.receive(answer, now_ns);
  }

  // Answers of `force` in every millisecond of the second before time zero: it is exerted in full by then.
  void fade_in(const Vec3& force) {
    for (std::int64_t ms = -1000; ms < 0; ++ms) {
      channel.tick(ms * kMs);
      answer(force, ms * kMs);
    }
  }
};

TEST_F(ToolChannelTest, PosesCountUpAndCarryTheMeasurementAndItsTime) {
  device->measurement.position = {1, 2, 3};
  device->measurement.orientation = Quat(0.5, 0.5, 0.5, 0.5);
  device->measurement.grip = 0.3;
  EXPECT_EQ(channel.tick(10).seq, 1u);
  const msg::ToolPose& pose = channel.tick(20);
  EXPECT_EQ(pose.seq, 2u);
  EXPECT_EQ(pose.tool, 3u);
  EXPECT_EQ(pose.stamp_ns, 20);
  EXPECT_TRUE(pose.valid);
  EXPECT_EQ(pose.position, (msg::Vec3{1, 2, 3}));
  EXPECT_EQ(pose.orientation, (msg::Quat{0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(pose.grip, 0.3);
}

TEST_F(ToolChannelTest, CommandsTheNewestAnswerWithinTheDevicesLimits) {
  fade_in({0, 0, 9});
  channel.tick(0);
  answer({1, 0, 0}, kMs);
  answer({0, 0, 9}, kMs);
  channel.tick(2 * kMs);
  EXPECT_EQ(device->commanded.force, Vec3(0, 0, 5));
}

TEST_F(ToolChannelTest, WithoutAnswersTheCommandedForceVanishes) {
  fade_in({0, 0, 2});
  channel.tick(0);
  EXPECT_EQ(device->commanded.force, Vec3(0, 0, 2));
  channel.tick(30 * kMs);
  EXPECT_EQ(device->commanded.force.norm(), 0);
  EXPECT_EQ(channel.expired(), 1u);
}

TEST_F(ToolChannelTest, AForceThatIsNotFiniteNeverReachesTheDevice) {
  answer({0, std::numeric_limits<double>::quiet_NaN(), 0}, 0);
  channel.tick(0);
  EXPECT_EQ(device->commanded.force.norm(), 0);
  ASSERT_EQ(faults.list().size(), 1u);
}

TEST_F(ToolChannelTest, AMeasurementThatIsNotFiniteGoesOutAsInvalid) {
  device->measurement.position.y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(channel.tick(0).valid);
  EXPECT_EQ(channel.tick(1).position.y, 0);
  ASSERT_EQ(faults.list().size(), 1u);
  EXPECT_EQ(faults.list()[0].count, 2u);
}

TEST_F(ToolChannelTest, ADeviceWithoutAMeasurementIsNoFault) {
  device->measurement.valid = false;
  EXPECT_FALSE(channel.tick(0).valid);
  EXPECT_FALSE(faults.any());
}

TEST_F(ToolChannelTest, EnergyIsTheForcesWorkOnTheHand) {
  fade_in({0, 0, 2});
  channel.tick(0);
  answer({0, 0, 2}, kMs);
  device->measurement.position = {0.1, 0, -0.03};  // against the force: the hand gives
  channel.tick(kMs);
  EXPECT_NEAR(channel.energy_j(), -0.06, 1e-12);
  device->measurement.position = {0, 0, 0};
  channel.tick(2 * kMs);
  EXPECT_NEAR(channel.energy_j(), 0, 1e-12);
}

TEST_F(ToolChannelTest, AJumpWhileTheMeasurementWasInvalidIsNoWork) {
  fade_in({0, 0, 2});
  channel.tick(0);
  answer({0, 0, 2}, 0);
  device->measurement.valid = false;
  channel.tick(kMs);
  device->measurement = {.valid = true, .position = {0, 0, 1}};
  channel.tick(2 * kMs);
  EXPECT_EQ(channel.energy_j(), 0);
}

TEST_F(ToolChannelTest, ReleaseLetsTheHandGo) {
  fade_in({0, 0, 2});
  channel.tick(0);
  ASSERT_GT(device->commanded.force.norm(), 0);
  channel.release();
  EXPECT_EQ(device->commanded.force.norm(), 0);
}

TEST(ToolChannel, PressingAnElasticWallGivesTheHandNoEnergy) {
  constexpr double kRate_hz = 1000, kWall_n_m = 500;
  const runtime::HandSpec hand;
  runtime::FaultList faults;
  ToolChannel channel(std::make_unique<VirtualHand>(hand, runtime::ToolSpec{}, kRate_hz), faults);
  double deepest = 0, stored_j = 0;
  for (int i = 0; i < static_cast<int>(script_period_s(hand) * kRate_hz); ++i) {
    const std::int64_t now_ns = i * kMs;
    const double depth = std::max(0.0, -channel.tick(now_ns).position.z);
    deepest = std::max(deepest, depth);
    stored_j = std::min(stored_j, channel.energy_j());
    msg::ToolForce force;
    force.force.z = kWall_n_m * depth;
    force.valid_for_s = 0.005;
    channel.receive(force, now_ns);
  }
  // on the way in the hand gives what the wall stores; it comes back on the way out. The wall answers half a
  // period late on average and one by the wire: energy of its force along that much way remains
  const double wall_j = 0.5 * kWall_n_m * deepest * deepest;
  EXPECT_NEAR(stored_j, -wall_j, 0.02 * wall_j);
  EXPECT_NEAR(channel.energy_j(), 0, 0.02 * wall_j);
}

TEST(ToolChannel, TicksUseNoHeap) {
  const runtime::HandSpec hand;
  runtime::ToolSpec tool;
  tool.trocar = runtime::Triple{0, 0.1, 0.2};
  runtime::FaultList faults;
  ToolChannel channel(std::make_unique<VirtualHand>(hand, tool, 1000), faults);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 12'000; ++i) {
    msg::ToolForce force;
    force.force.z = i % 100 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    force.valid_for_s = 0.005;
    channel.receive(force, i * kMs);
    channel.tick(i * kMs);
  }
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::device
