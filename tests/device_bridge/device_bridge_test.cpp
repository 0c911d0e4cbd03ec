// The bridge on a real bus of each vendor, against an elastic wall that answers as haptic_node would.
#include "device_bridge/device_bridge.h"

#include "device_bridge/virtual_hand.h"
#include "runtime/clock.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace omentum::device {
namespace {

constexpr double kWall_n_m = 500;

// Answers every valid pose, and echoes the newest one as deform_node and render_node do.
class Wall {
 public:
  Wall(const std::string& vendor, int domain)
      : bus_(transport::Bus::open(
            {.vendor = transport::parse_vendor(vendor), .domain = domain, .name = "wall"})),
        forces_(bus_->writer<msg::ToolForce>()),
        statuses_(bus_->writer<msg::NodeStatus>()),
        commands_(bus_->writer<msg::SessionCommand>()),
        infos_(bus_->reader<msg::DeviceInfo>(
            [this](const msg::DeviceInfo& info) { info_force_n = info.max_force_n; })),
        devices_(bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& s) {
          if (s.kind == msg::NODE_DEVICE) device_paused = s.paused, device_tools = s.tools_served;
        })),
        poses_(bus_->reader<msg::ToolPose>([this](const msg::ToolPose& pose) { answer(pose); })) {}

  void send(std::uint32_t command) {
    msg::SessionCommand message;
    message.seq = ++command_seq_;
    message.command = command;
    commands_->write(message);
  }

  std::atomic<double> info_force_n{0};
  std::atomic<bool> device_paused{false};
  std::atomic<std::uint32_t> device_tools{0};
  std::atomic<double> pose_z{0};

 private:
  void answer(const msg::ToolPose& pose) {
    pose_z = pose.position.z;
    if (!pose.valid) return;
    msg::ToolForce force;
    force.tool = pose.tool;
    force.seq = ++force_seq_;
    force.echo_seq = pose.seq;
    force.echo_stamp_ns = pose.stamp_ns;
    force.force.z = kWall_n_m * std::max(0.0, -pose.position.z);
    force.valid_for_s = 0.005;
    forces_->write(force);
    if (force_seq_ % 100 != 0) return;
    msg::NodeStatus status;
    status.echoes = {{pose.tool, pose.seq, pose.stamp_ns}};
    for (const auto kind : {msg::NODE_DEFORM, msg::NODE_RENDER}) {
      status.kind = kind;
      statuses_->write(status);
    }
  }

  std::uint64_t force_seq_ = 0, command_seq_ = 0;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> statuses_;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> commands_;
  std::unique_ptr<transport::Reader<msg::DeviceInfo>> infos_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> devices_;
  std::unique_ptr<transport::Reader<msg::ToolPose>> poses_;
};

// Presses within a second of its start and holds for long.
runtime::HandSpec eager_hand() {
  runtime::HandSpec hand;
  hand.tool = 5;
  hand.start_s = 0;
  hand.approach_s = 0.3;
  hand.press_s = 0.3;
  hand.hold_s = 60;
  return hand;
}

class DeviceBridgeTest : public ::testing::TestWithParam<const char*> {
 protected:
  DeviceBridgeTest() {
    options_.node.dds = GetParam();
    options_.node.domain = test::domain_of_test();
    wall_ = std::make_unique<Wall>(options_.node.dds, options_.node.domain);
    std::vector<std::unique_ptr<Device>> devices;
    devices.push_back(std::make_unique<VirtualHand>(eager_hand(), runtime::ToolSpec{}, loop_.rate_hz()));
    bridge_ = std::make_unique<DeviceBridge>(options_, std::move(devices), loop_);
    thread_ = std::thread([this] { bridge_->run(); });
  }
  ~DeviceBridgeTest() override { end(); }

  void end() {
    loop_.stop();
    if (thread_.joinable()) thread_.join();
  }

  runtime::RateLoop loop_{500};
  BridgeOptions options_;
  std::unique_ptr<Wall> wall_;
  std::unique_ptr<DeviceBridge> bridge_;
  std::thread thread_;
};

TEST_P(DeviceBridgeTest, TheHandFeelsTheWallAndTheReportSaysSo) {
  // the two springs' equilibrium: 4/9 of the depth
  ASSERT_TRUE(test::comes_true([&] { return std::abs(wall_->pose_z + 0.010 * 4 / 9) < 1e-4; }));
  ASSERT_TRUE(test::comes_true([&] { return wall_->device_tools == 1U << 5; }));
  EXPECT_GT(wall_->info_force_n, 0);
  end();

  const nlohmann::json report = bridge_->report();
  EXPECT_EQ(report["dds"], GetParam());
  EXPECT_GT(report["round_trip_us"]["count"], 0);
  EXPECT_GT(report["link"]["tool_to_organ_us"]["count"], 0);
  EXPECT_GT(report["link"]["tool_to_picture_us"]["count"], 0);
  EXPECT_GT(report["sent"], 0);
  EXPECT_TRUE(report["lost"].is_number());
  EXPECT_LT(report["energy_j"], 0);  // the hand deformed the wall
  EXPECT_TRUE(report["faults"].empty()) << report["faults"];
  EXPECT_GT(report["hands"][0]["peak_force_n"], 2.0);
  EXPECT_EQ(report["hands"][0]["tool"], 5);
}

TEST_P(DeviceBridgeTest, ObeysPauseAndStart) {
  ASSERT_TRUE(test::comes_true([&] { return wall_->device_tools != 0; }));
  ASSERT_TRUE(test::comes_true([&] {
    wall_->send(msg::COMMAND_PAUSE);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return wall_->device_paused.load();
  }));
  ASSERT_TRUE(test::comes_true([&] {
    wall_->send(msg::COMMAND_START);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return !wall_->device_paused;
  }));
}

INSTANTIATE_TEST_SUITE_P(Vendors, DeviceBridgeTest, ::testing::Values("fast", "cyclone"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace omentum::device
