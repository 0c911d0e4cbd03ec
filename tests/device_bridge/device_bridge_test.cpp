// The bridge on a real bus of each vendor, against an elastic wall that answers as haptic_node would.
#include "device_bridge/device_bridge.h"

#include "device_bridge/virtual_hand.h"
#include "node_common/node_identity.h"
#include "runtime/rate_loop.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace omentum::device {
namespace {

constexpr double kWall_n_m = 500;
// A breath of force that the wall adds everywhere, N: who feels it is answered. It moves the hand by a
// micrometre.
constexpr double kBreath_n = 1e-3;

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
    command_.order += 1;
    command_.command = command;
    send_again();
  }
  // omentum_session sends each command twice: the first copy may be lost while endpoints find each other
  void send_again() { commands_->write(command_); }

  std::atomic<double> info_force_n{0};
  std::atomic<bool> device_paused{false};
  std::atomic<std::uint32_t> device_tools{0};
  std::atomic<double> pose_z{0};
  std::atomic<std::uint64_t> numbers{0};  // of answers, those that are withheld included

  // every so many numbers one is not sent: a lost answer
  static constexpr std::uint64_t kWithheldOf = 10;

 private:
  void answer(const msg::ToolPose& pose) {
    pose_z = pose.position.z;
    if (!pose.valid || ++numbers % kWithheldOf == 0) return;
    msg::ToolForce force;
    force.tool = pose.tool;
    force.seq = numbers;
    force.echo_seq = pose.seq;
    force.echo_stamp_ns = pose.stamp_ns;
    force.force.z = kBreath_n + kWall_n_m * std::max(0.0, -pose.position.z);
    force.valid_for_s = 0.02;  // a busy machine stops a process for longer than haptic_node would allow
    forces_->write(force);
    if (numbers % 100 != 1) return;
    msg::NodeStatus status;
    status.echoes = {{pose.tool, pose.seq, pose.stamp_ns}};
    for (const auto kind : {msg::NODE_DEFORM, msg::NODE_RENDER}) {
      status.kind = kind;
      statuses_->write(status);
    }
  }

  msg::SessionCommand command_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> statuses_;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> commands_;
  std::unique_ptr<transport::Reader<msg::DeviceInfo>> infos_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> devices_;
  std::unique_ptr<transport::Reader<msg::ToolPose>> poses_;
};

/// Counts what the session asks of it, and begins when it is answered: a hand that pressed before would be
/// pushed out and gain energy.
class ObservedHand : public VirtualHand {
 public:
  using VirtualHand::VirtualHand;
  void command(const Wrench& wrench) noexcept override {
    answered_ = answered_ || wrench.force.norm() > 0;
    VirtualHand::command(wrench);
  }
  void pause(bool paused) noexcept override {
    ++(paused ? paused_periods : running_periods);
    VirtualHand::pause(paused || !answered_);
  }
  void restart() noexcept override {
    ++restarts;
    VirtualHand::restart();
  }

  std::atomic<int> paused_periods{0}, running_periods{0}, restarts{0};

 private:
  bool answered_ = false;
};

// Presses within a second of its start and holds for long.
scene::HandSpec eager_hand() {
  scene::HandSpec hand;
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
    options_.rate_hz = loop_.rate_hz();
    wall_ = std::make_unique<Wall>(options_.node.dds, options_.node.domain);
    auto hand = std::make_unique<ObservedHand>(eager_hand(), scene::ToolSpec{}, loop_.rate_hz());
    hand_ = hand.get();
    std::vector<std::unique_ptr<Device>> devices;
    devices.push_back(std::move(hand));
    const auto open_bus = [this] { return node::open_bus(options_.node, "virtual_device"); };
    bridge_ = std::make_unique<DeviceBridge>(options_, std::move(devices), open_bus, loop_);
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
  const ObservedHand* hand_ = nullptr;  // the bridge's
  std::unique_ptr<DeviceBridge> bridge_;
  std::thread thread_;
};

TEST_P(DeviceBridgeTest, TheHandFeelsTheWallAndTheReportSaysSo) {
  // the two springs' equilibrium: 4/9 of the depth; a hand that sank in because answers came too late is not
  // pushed out (hand_guard.h), so that it presses again
  const auto in_balance = [&] { return std::abs(wall_->pose_z + 0.010 * 4 / 9) < 1e-4; };
  ASSERT_TRUE(test::comes_true([&] {
    constexpr int kLooks = 600;  // of 5 ms: several times as long as a press
    for (int look = 0; look < kLooks; ++look) {
      if (in_balance()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    wall_->send(msg::COMMAND_RESET);
    return false;
  }));
  ASSERT_TRUE(test::comes_true([&] { return wall_->device_tools == 1U << 5; }));
  EXPECT_GT(wall_->info_force_n, 0);
  end();

  const nlohmann::json report = bridge_->report();
  EXPECT_EQ(report["dds"], GetParam());
  EXPECT_GT(report["round_trip_us"]["count"], 0);
  EXPECT_GT(report["link"]["tool_to_organ_us"]["count"], 0);
  EXPECT_GT(report["link"]["tool_to_picture_us"]["count"], 0);
  EXPECT_GT(report["sent"], 0);
  // the hand deformed the wall; after an expiry it may have sunk in unfelt and been pushed out
  if (report["expired"] == 0) {
    EXPECT_LT(report["energy_j"], 0);
  }
  EXPECT_TRUE(report["faults"].empty()) << report["faults"];
  EXPECT_GT(report["hands"][0]["peak_force_n"], 2.0);
  EXPECT_EQ(report["hands"][0]["tool"], 5);
}

TEST_P(DeviceBridgeTest, TellsLostAnswersFromUnansweredPoses) {
  constexpr std::uint64_t kEnough = 200;
  ASSERT_TRUE(test::comes_true([&] { return wall_->device_tools != 0 && wall_->numbers > kEnough; }));
  end();

  const nlohmann::json report = bridge_->report();
  const std::uint64_t answers = report["answers"], lost = report["lost"], unanswered = report["unanswered"];
  ASSERT_GT(answers, 0u);
  // at least those that the wall withheld between the first and the last that came
  EXPECT_GE(lost, (answers + lost) / Wall::kWithheldOf - 1);
  EXPECT_LE(answers + lost, wall_->numbers);
  // the wall gives each pose that it hears a number: a lost number is a pose without an answer
  EXPECT_GE(unanswered, lost);
  EXPECT_LE(answers + unanswered, report["sent"].get<std::uint64_t>());
  EXPECT_EQ(report["refused"]["foreign"], 0);
}

TEST_P(DeviceBridgeTest, ACommandThatArrivesTwiceIsObeyedOnce) {
  // once one command has come, the next ones come too, in order
  ASSERT_TRUE(test::comes_true([&] {
    wall_->send(msg::COMMAND_PAUSE);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return hand_->paused_periods > 0;
  }));
  wall_->send(msg::COMMAND_RESET);
  ASSERT_TRUE(test::comes_true([&] { return hand_->restarts == 1; }));

  const int running = hand_->running_periods;
  wall_->send_again();
  wall_->send(msg::COMMAND_START);
  // what came before START is obeyed in the period that follows it, if not before
  ASSERT_TRUE(test::comes_true([&] { return hand_->running_periods > running + 1; }));
  EXPECT_EQ(hand_->restarts, 1);

  wall_->send(msg::COMMAND_RESET);
  EXPECT_TRUE(test::comes_true([&] { return hand_->restarts == 2; })) << "a new command is new";
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
