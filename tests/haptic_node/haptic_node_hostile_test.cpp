// The real haptic_node, a hand that presses, and a client that sends anything under the hand's name at 9 kHz.
#include "tests/haptic_node/force_watch.h"
#include "tests/haptic_node/haptic_bench.h"
#include "tests/haptic_node/hostile_poses.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum {
namespace {

using haptic_test::ForceWatch;
using haptic_test::HostilePoses;
using haptic_test::kAbove;
using haptic_test::NodeBench;

class HostileClient {
 public:
  explicit HostileClient(NodeBench& bench)
      : bus_(transport::Bus::open(
            {.vendor = transport::Vendor::kFast, .domain = bench.domain(), .name = "hostile"})),
        hand_(bus_->writer<msg::ToolPose>()),
        client_(bus_->writer<msg::ToolPose>()),
        poses_(bench.seq()),
        forces_(bus_->reader<msg::ToolForce>([this](const msg::ToolForce& force) {
          const std::lock_guard lock(mutex_);
          if (force.tool == 0) watch_.see(force);
        })) {}

  /// The hand alone, until the tool is its: of two that came to a free tool the node could not tell which is
  /// the hand.
  bool takes_tool() {
    const std::int64_t begin_ns = runtime::steady_now_ns();
    return test::comes_true([&] {
      press(20, 0);
      return watch().newest().echo_stamp_ns >= begin_ns;
    });
  }
  void press(int milliseconds, int rubbish = 9) {
    auto due = std::chrono::steady_clock::now();
    for (int ms = 0; ms < milliseconds; ++ms) {
      const msg::ToolPose honest = poses_.honest(runtime::steady_now_ns());
      for (int i = 0; i < rubbish; ++i) client_->write(poses_.rubbish());
      hand_->write(honest);
      std::this_thread::sleep_until(due += std::chrono::milliseconds(1));
    }
  }
  /// Of what was seen until now.
  ForceWatch watch() const {
    const std::lock_guard lock(mutex_);
    return watch_;
  }

 private:
  mutable std::mutex mutex_;
  ForceWatch watch_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolPose>> hand_, client_;
  HostilePoses poses_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> forces_;
};

TEST(HapticNodeUnderFire, KeepsEveryLimitAndLetsTheHandFeel) {
  const test::BlockScene block = haptic_test::block_scene();
  NodeBench bench(block, "cyclone", transport::Vendor::kCyclone);
  bench.send(block.info());
  ASSERT_TRUE(bench.hold(kAbove, [&] { return bench.force() && bench.force()->state == 0; }))
      << bench.node().messages();
  HostileClient client(bench);
  ASSERT_TRUE(client.takes_tool()) << bench.node().messages();
  // a busy machine ends a press, and a hand that is lost in the organ feels nothing until it has come out
  constexpr double kFelt_n = 0.1;
  ASSERT_TRUE(test::comes_true([&] {
    client.press(1000);
    return client.watch().largest_n() > kFelt_n || !client.watch().broken().empty();
  })) << "a force of zero is safe and useless";
  client.press(1000);
  EXPECT_EQ(client.watch().broken(), "");

  // silence: by the node's own ticks, which come no faster than 1 kHz then
  const ForceWatch last = client.watch();
  const double ends_s = last.newest().valid_for_s + last.limits.decay_s;
  const auto ends_tick = last.newest().tick + static_cast<std::uint64_t>(ends_s / last.limits.period_s) + 5;
  ASSERT_TRUE(test::comes_true([&] { return client.watch().newest().tick >= ends_tick; }));
  EXPECT_EQ(client.watch().newest_n(), 0);
  EXPECT_EQ(client.watch().broken(), "");

  EXPECT_EQ(bench.node().terminate(), 0) << bench.node().messages();
  const auto report = nlohmann::json::parse(test::read_text(block.report()));
  EXPECT_NE(report["faults"].dump().find("tool 0: pose refused"), std::string::npos) << report["faults"];
  EXPECT_EQ(report["faults"].dump().find("held at zero"), std::string::npos) << report["faults"];
}

}  // namespace
}  // namespace omentum
