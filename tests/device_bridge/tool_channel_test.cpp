#include "device_bridge/tool_channel.h"

#include "device_bridge/virtual_hand.h"
#include "tests/support/heap_count.h"
#include "tests/support/milliseconds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace omentum::device {
namespace {

using test::kMs;

// A device whose measurement the test sets and whose command it sees.
struct FakeDevice : Device {
  FakeDevice() {
    limits.tool = 3;
    limits.max_force_n = 5;
    limits.max_torque_nm = 1;
  }
  msg::DeviceInfo info() const override { return limits; }
  void command(const Wrench& wrench) noexcept override { commanded = wrench; }
  bool simulates() const noexcept override { return simulated; }
  Measurement measure(std::int64_t now_ns) noexcept override {
    if (alive) measurement.measured_ns = now_ns - age_ns;
    return measurement;
  }

  msg::DeviceInfo limits;
  Measurement measurement{.valid = true};
  bool alive = true;  // false: its last measurement stays behind
  bool simulated = false;
  std::int64_t age_ns = 0;  // of its measurements when they are read
  Wrench commanded;
};

struct ToolChannelTest : ::testing::Test {
  runtime::FaultList faults;
  FakeDevice* device = new FakeDevice;
  ToolChannel channel{std::unique_ptr<Device>(device), faults};
  msg::ToolPose pose;  // the newest
  std::uint64_t answers = 0;

  const msg::ToolPose& tick(std::int64_t now_ns) { return pose = channel.tick(now_ns); }

  // an answer to the newest pose, as haptic_node makes it
  msg::ToolForce answer_with(const Vec3& force) {
    msg::ToolForce answer;
    answer.tool = 3;
    answer.seq = ++answers;
    answer.echo_seq = pose.seq;
    answer.echo_stamp_ns = pose.stamp_ns;
    answer.force = to_message(force);
    answer.valid_for_s = 0.005;
    return answer;
  }
  void answer(const Vec3& force, std::int64_t now_ns) { channel.receive(answer_with(force), now_ns); }

  // Answers of `force` in every millisecond of the second before time zero: it is exerted in full by then.
  void fade_in(const Vec3& force) {
    for (std::int64_t ms = -1000; ms < 0; ++ms) {
      tick(ms * kMs);
      answer(force, ms * kMs);
    }
  }
};

TEST_F(ToolChannelTest, LimitsThatLimitNothingAreRefusedAtTheStart) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    for (const auto member : {&msg::DeviceInfo::max_force_n, &msg::DeviceInfo::max_torque_nm}) {
      auto wrong = std::make_unique<FakeDevice>();
      wrong->limits.*member = bad;
      EXPECT_THROW(ToolChannel(std::move(wrong), faults), std::runtime_error) << bad;
    }
  }
  auto nobodys = std::make_unique<FakeDevice>();
  nobodys->limits.tool = msg::MAX_TOOLS;
  EXPECT_THROW(ToolChannel(std::move(nobodys), faults), std::runtime_error);
}

TEST_F(ToolChannelTest, PosesCountUpAndCarryTheMeasurementAndItsTime) {
  device->measurement.position = {1, 2, 3};
  device->measurement.orientation = Quat(0.5, 0.5, 0.5, 0.5);
  device->measurement.grip = 0.3;
  EXPECT_EQ(tick(10).seq, 1u);
  const msg::ToolPose& pose = tick(20);
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
  tick(0);
  answer({1, 0, 0}, kMs);
  answer({0, 0, 9}, kMs);
  tick(2 * kMs);
  EXPECT_EQ(device->commanded.force, Vec3(0, 0, 5));
}

TEST_F(ToolChannelTest, WithoutAnswersTheCommandedForceVanishes) {
  fade_in({0, 0, 2});
  tick(0);
  EXPECT_EQ(device->commanded.force, Vec3(0, 0, 2));
  tick(30 * kMs);
  EXPECT_EQ(device->commanded.force.norm(), 0);
  EXPECT_EQ(channel.expired(), 1u);
}

TEST_F(ToolChannelTest, APoseNamesTheAnswerUnderWhichTheHandCameThere) {
  EXPECT_EQ(tick(0).answer_seq, 0u) << "none came yet";
  answer({0, 0, 2}, kMs);
  EXPECT_EQ(tick(kMs).answer_seq, 0u) << "hardware moved under the command before";
  EXPECT_EQ(tick(2 * kMs).answer_seq, 1u) << "held without a new one";
  answer({0, 0, 2}, 3 * kMs);
  device->measurement.valid = false;
  EXPECT_EQ(tick(3 * kMs).answer_seq, 1u);
  EXPECT_EQ(tick(4 * kMs).answer_seq, 2u) << "whether it is measured or not";
  answer({0, 0, std::numeric_limits<double>::quiet_NaN()}, 5 * kMs);
  tick(5 * kMs);
  EXPECT_EQ(tick(6 * kMs).answer_seq, 2u) << "what was not exerted is not named";
}

TEST_F(ToolChannelTest, ASimulatedHandMovesUnderTheNewestAnswer) {
  device->simulated = true;
  tick(0);
  answer({0, 0, 2}, kMs);
  EXPECT_EQ(tick(kMs).answer_seq, 1u);
}

TEST_F(ToolChannelTest, AnAnswerIsNamedUntilNothingIsLeftOfIt) {
  constexpr auto kDecay_ns = static_cast<std::int64_t>(1e9 * ForceHold::kDecay_s);
  device->simulated = true;
  fade_in({0, 0, 2});
  const std::int64_t expired_ns = -kMs + 5 * kMs;  // valid_for_s after the last one
  EXPECT_EQ(tick(expired_ns + kDecay_ns / 2).answer_seq, answers);
  EXPECT_GT(device->commanded.force.norm(), 0) << "it decays";
  EXPECT_EQ(tick(expired_ns + kDecay_ns).answer_seq, 0u);
  EXPECT_EQ(device->commanded.force.norm(), 0);
}

TEST_F(ToolChannelTest, AForceThatIsNotFiniteNeverReachesTheDevice) {
  fade_in({0, 0, 2});
  tick(0);
  answer({0, std::numeric_limits<double>::quiet_NaN(), 0}, kMs);
  tick(kMs);
  EXPECT_EQ(device->commanded.force, Vec3(0, 0, 2));
  tick(100 * kMs);
  EXPECT_EQ(device->commanded.force.norm(), 0);
  ASSERT_EQ(faults.list().size(), 1u);
}

TEST_F(ToolChannelTest, AnotherDevicesForceIsNotExertedAndIsAFault) {
  fade_in({0, 0, 2});
  tick(0);
  msg::ToolForce foreign = answer_with({0, 0, 5});
  foreign.echo_stamp_ns -= kMs / 2;
  EXPECT_EQ(channel.receive(foreign, kMs), AnswerVerdict::kForeign);
  tick(kMs);
  EXPECT_EQ(device->commanded.force, Vec3(0, 0, 2));
  EXPECT_EQ(faults.list().size(), 1u);
  EXPECT_EQ(channel.answers().foreign, 1u);
}

TEST_F(ToolChannelTest, AnAnswerThatWasKeptBackIsNotExerted) {
  fade_in({0, 0, 2});
  tick(0);
  const msg::ToolForce kept_back = answer_with({0, 0, 5});
  EXPECT_EQ(channel.receive(kept_back, 500 * kMs), AnswerVerdict::kLate);
  tick(500 * kMs);
  EXPECT_EQ(device->commanded.force.norm(), 0);
  EXPECT_FALSE(faults.any());
}

TEST_F(ToolChannelTest, AMeasurementThatIsNotFiniteGoesOutAsInvalid) {
  device->measurement.position.y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(tick(0).valid);
  EXPECT_EQ(tick(1).position.y, 0);
  ASSERT_EQ(faults.list().size(), 1u);
  EXPECT_EQ(faults.list()[0].count, 2u);
}

TEST_F(ToolChannelTest, APoseIsStampedWithTheTimeOfItsMeasurementNotOfItsReading) {
  device->age_ns = 3 * kMs;
  EXPECT_EQ(tick(100 * kMs).stamp_ns, 97 * kMs);
  EXPECT_TRUE(pose.valid);
}

TEST_F(ToolChannelTest, TheLastMeasurementOfADeadCallbackIsNotAMeasurementForEver) {
  constexpr auto kOldest_ns = static_cast<std::int64_t>(1e9 * kOldestMeasurement_s);
  tick(0);
  device->alive = false;
  EXPECT_TRUE(tick(kOldest_ns).valid);
  EXPECT_EQ(pose.stamp_ns, 0) << "an old measurement must not look young";
  EXPECT_FALSE(tick(kOldest_ns + 1).valid);
  EXPECT_FALSE(tick(1000 * kMs).valid);
  ASSERT_EQ(faults.list().size(), 1u);
  device->alive = true;
  EXPECT_TRUE(tick(1001 * kMs).valid);
}

TEST_F(ToolChannelTest, AMeasurementOfAnotherClockOrOfNoTimeIsNone) {
  for (const std::int64_t measured_ns : {std::int64_t{0}, std::numeric_limits<std::int64_t>::min(),
                                         std::numeric_limits<std::int64_t>::max(), 5000 * kMs}) {
    device->alive = false;
    device->measurement.measured_ns = measured_ns;
    EXPECT_FALSE(tick(1000 * kMs).valid) << measured_ns;
  }
}

TEST_F(ToolChannelTest, ADeviceWithoutAMeasurementIsNoFault) {
  device->measurement.valid = false;
  EXPECT_FALSE(tick(0).valid);
  EXPECT_FALSE(faults.any());
}

TEST_F(ToolChannelTest, EnergyIsTheForcesWorkOnTheHand) {
  fade_in({0, 0, 2});
  const auto move_to = [this](double share, std::int64_t ms) {
    device->measurement.position = share * Vec3(0.1, 0, -0.03);
    tick(ms * kMs);
    answer({0, 0, 2}, ms * kMs);
  };
  for (int ms = 0; ms <= 1000; ++ms) move_to(1e-3 * ms, ms);  // against the force: the hand gives
  EXPECT_NEAR(channel.energy_j(), -0.06, 1e-12);
  for (int ms = 1001; ms <= 2000; ++ms) move_to(2 - 1e-3 * ms, ms);
  EXPECT_NEAR(channel.energy_j(), 0, 1e-12);
}

TEST_F(ToolChannelTest, AJumpWhileTheMeasurementWasInvalidIsNoWork) {
  fade_in({0, 0, 2});
  tick(0);
  answer({0, 0, 2}, 0);
  device->measurement.valid = false;
  tick(kMs);
  device->measurement = {.valid = true, .position = {0, 0, 1}};
  tick(2 * kMs);
  EXPECT_EQ(channel.energy_j(), 0);
}

TEST_F(ToolChannelTest, ReleaseLetsTheHandGo) {
  fade_in({0, 0, 2});
  tick(0);
  ASSERT_GT(device->commanded.force.norm(), 0);
  channel.release();
  EXPECT_EQ(device->commanded.force.norm(), 0);
}

TEST(ToolChannel, PressingAnElasticWallGivesTheHandNoEnergy) {
  constexpr double kRate_hz = 1000, kWall_n_m = 500;
  const scene::HandSpec hand;
  runtime::FaultList faults;
  ToolChannel channel(std::make_unique<VirtualHand>(hand, scene::ToolSpec{}, kRate_hz), faults);
  double deepest = 0, stored_j = 0;
  for (int i = 0; i < static_cast<int>(script_period_s(hand) * kRate_hz); ++i) {
    const std::int64_t now_ns = i * kMs;
    const msg::ToolPose& pose = channel.tick(now_ns);
    const double depth = std::max(0.0, -pose.position.z);
    deepest = std::max(deepest, depth);
    stored_j = std::min(stored_j, channel.energy_j());
    msg::ToolForce force;
    force.seq = force.echo_seq = pose.seq;
    force.echo_stamp_ns = pose.stamp_ns;
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
  const scene::HandSpec hand;
  scene::ToolSpec tool;
  tool.trocar = scene::Vec3{0, 0.1, 0.2};
  runtime::FaultList faults;
  ToolChannel channel(std::make_unique<VirtualHand>(hand, tool, 1000), faults);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 12'000; ++i) {
    const msg::ToolPose& pose = channel.tick(i * kMs);
    msg::ToolForce force;
    force.seq = force.echo_seq = pose.seq;
    force.echo_stamp_ns = i % 70 == 0 ? 0 : pose.stamp_ns;
    force.force.z = i % 100 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    force.valid_for_s = 0.005;
    channel.receive(force, i * kMs);
  }
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::device
