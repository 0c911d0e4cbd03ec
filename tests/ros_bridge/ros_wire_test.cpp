// What one vendor puts on a topic of ROS the other one reads, and a tool of a session comes out as CRTK's.
#include "ros_bridge/republisher.h"
#include "runtime/clock.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

namespace omentum::ros {
namespace {

using transport::Vendor;

template <class Condition>
bool comes_true(Condition&& condition) {
  constexpr int kPatience = 2000;  // of 5 ms: a busy machine's discovery
  for (int i = 0; i < kPatience; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

struct SteadyClock : runtime::Clock {
  std::int64_t now_ns() const noexcept override { return runtime::steady_now_ns(); }
};

// (who republishes, who listens)
struct RosWireTest : ::testing::TestWithParam<std::pair<Vendor, Vendor>> {
  transport::BusOptions options(Vendor vendor) const {
    return {.vendor = vendor, .domain = domain, .name = "ros_wire_test"};
  }
  int domain = test::domain_of_test();
};

// What a node of ROS sees of one tool.
struct Seen {
  std::mutex mutex;
  PoseStamped pose{};
  WrenchStamped force{};
  CartesianState state{};
  std::string frame, operating;
  std::atomic<int> poses{0}, forces{0}, states{0}, operatings{0};
};

TEST_P(RosWireTest, AToolIsSeenAndItsSessionPaused) {
  const auto [own, others] = GetParam();
  const SteadyClock clock;
  const auto bus = transport::Bus::open(options(own));
  const auto port = RosPort::open(options(own)), listener = RosPort::open(options(others));
  RepublisherOptions told;
  told.obeys = true;
  told.names[2] = "PSM1";
  Republisher republisher(told, *bus, *port, clock);

  const auto poses = bus->writer<msg::ToolPose>();
  const auto forces = bus->writer<msg::ToolForce>();
  std::atomic<int> pauses{0};
  const auto commands = bus->reader<msg::SessionCommand>([&](const msg::SessionCommand& command) {
    if (command.command == msg::COMMAND_PAUSE) ++pauses;
  });

  Seen seen;
  const auto cp = listener->subscription<PoseStamped>({"rt/PSM1/measured_cp"}, [&](const PoseStamped& pose) {
    const std::lock_guard lock(seen.mutex);
    if (pose.header_.stamp_.sec_ == 0) return;
    seen.pose = pose;
    seen.frame = pose.header_.frame_id_;
    ++seen.poses;
  });
  const auto cf =
      listener->subscription<WrenchStamped>({"rt/PSM1/spatial/servo_cf"}, [&](const WrenchStamped& force) {
        const std::lock_guard lock(seen.mutex);
        if (force.header_.stamp_.sec_ == 0) return;
        seen.force = force;
        ++seen.forces;
      });
  const auto cs =
      listener->subscription<CartesianState>({"rt/PSM1/measured_cs"}, [&](const CartesianState& state) {
        const std::lock_guard lock(seen.mutex);
        if (!state.twist_is_valid_.data_) return;
        seen.state = state;
        ++seen.states;
      });

  msg::ToolPose pose;
  pose.tool = 2;
  pose.valid = true;
  pose.position = {0.1, 0.2, 0.3};
  pose.orientation = {0.5, 0.5, -0.5, 0.5};
  pose.angular_velocity = {0, 0, 1.5};
  msg::ToolForce force;
  force.tool = 2;
  force.force = {0, 0, 2.5};
  constexpr std::int64_t kWall_ns = 1'700'000'000'000'000'000;
  const auto go_on = [&] {
    ++pose.seq, ++force.seq;
    poses->write(pose);
    forces->write(force);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    republisher.tick(kWall_ns);
  };
  EXPECT_TRUE(comes_true([&] {
    go_on();
    return seen.poses > 0 && seen.forces > 0 && seen.states > 0;
  }));
  {
    const std::lock_guard lock(seen.mutex);
    EXPECT_EQ(seen.frame, "world");
    EXPECT_NEAR(seen.pose.header_.stamp_.sec_ + 1e-9 * seen.pose.header_.stamp_.nanosec_, 1e-9 * kWall_ns,
                kFresh_s + 1e-6);
    EXPECT_EQ(seen.pose.pose_.position_.y_, 0.2);
    EXPECT_EQ(seen.pose.pose_.orientation_.w_, 0.5);
    EXPECT_EQ(seen.pose.pose_.orientation_.y_, -0.5);
    EXPECT_EQ(seen.force.wrench_.force_.z_, 2.5);
    EXPECT_EQ(seen.state.twist_.angular_.z_, 1.5);
    EXPECT_FALSE(seen.state.wrench_is_valid_.data_);
  }

  // who comes later is told the state, which does not change meanwhile
  const auto operating = listener->subscription<OperatingState>({"rt/PSM1/operating_state", true},
                                                                [&](const OperatingState& state) {
                                                                  const std::lock_guard lock(seen.mutex);
                                                                  seen.operating = state.state_;
                                                                  ++seen.operatings;
                                                                });
  EXPECT_TRUE(comes_true([&] {
    go_on();
    const std::lock_guard lock(seen.mutex);
    return seen.operating == "ENABLED";
  }));

  const auto asks = listener->publisher<StringStamped>({"rt/PSM1/state_command"});
  std::string empty, pause = "pause";
  const StringStamped command{{{0, 0}, empty.data()}, pause.data()};
  EXPECT_TRUE(comes_true([&] {
    go_on();
    asks->publish(command);
    return pauses > 0;
  }));
  EXPECT_EQ(republisher.refused(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Vendors, RosWireTest,
                         ::testing::Values(std::pair(Vendor::kFast, Vendor::kCyclone),
                                           std::pair(Vendor::kCyclone, Vendor::kFast)),
                         [](const auto& info) {
                           return info.param.first == Vendor::kFast ? "FastToCyclone" : "CycloneToFast";
                         });

}  // namespace
}  // namespace omentum::ros
