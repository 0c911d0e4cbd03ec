// What strangers tell on the topics, and what a haptic_node makes of it: nothing takes a hand's force away,
// and nothing lifts a device's limits.
#include "tests/nodes/haptic_bench.h"

#include <gtest/gtest.h>

namespace omentum {
namespace {

using geometry::Vec3;
using haptic_test::BlockScene;
using haptic_test::kRelative;
using haptic_test::kSettled_s;
using haptic_test::NodeBench;

class HapticStrangersTest : public ::testing::TestWithParam<std::pair<std::string, transport::Vendor>> {
 protected:
  bool is_settled() {
    return bench_.hold(NodeBench::kAbove, [&] {
      const auto status = bench_.status();
      return status && static_cast<double>(status->ticks) > kSettled_s * status->rate_hz;
    });
  }

  BlockScene block_;
  NodeBench bench_{block_, GetParam().first, GetParam().second};
};

TEST_P(HapticStrangersTest, AnotherNodeForItsToolsYields) {
  ASSERT_TRUE(test::comes_true([&] { return bench_.status().has_value(); }));
  test::Process second("haptic_node", bench_.arguments(block_.report() + ".second"));
  EXPECT_EQ(second.wait(), 2);
  EXPECT_NE(second.messages().find("already served"), std::string::npos) << second.messages();
  EXPECT_TRUE(bench_.node().running());
}

TEST_P(HapticStrangersTest, AnotherOrganFileIsRefusedWithBothHashes) {
  bench_.send(block_.info("abc"));
  EXPECT_EQ(bench_.node().wait(), 2);
  EXPECT_NE(bench_.node().messages().find("abc"), std::string::npos) << bench_.node().messages();
  EXPECT_NE(bench_.node().messages().find(block_.organ_hash()), std::string::npos);
}

TEST_P(HapticStrangersTest, AStrangersSceneDoesNotEndAPress) {
  const std::string other = "scene: a deform_node with other organs";
  const msg::SceneInfo strangers = block_.info("abc");
  ASSERT_TRUE(is_settled());
  EXPECT_TRUE(bench_.press_outlives([&] {
    const std::string before = bench_.fault(other);
    bench_.send(strangers);
    return bench_.hold(NodeBench::kPressed, [&] { return bench_.fault(other) != before; });
  })) << bench_.node().messages();
  EXPECT_TRUE(bench_.node().running());
}

/// Statuses of a haptic_node that only exists on the wire, as a living one would tell them.
class ForgedNode {
 public:
  explicit ForgedNode(std::uint32_t tools) {
    status_.kind = msg::NODE_HAPTIC;
    status_.instance = 1;  // older than any
    status_.tools_served = tools;
    status_.rate_hz = 1000;
    status_.ticks = 1'000'000'000;
    status_.host = "elsewhere";
  }
  const msg::NodeStatus& next() {
    status_.ticks += 100;
    return status_;
  }

 private:
  msg::NodeStatus status_{};
};

// A tool in dispute is one tool: the others go on.
TEST_P(HapticStrangersTest, AYoungNodeLeavesToAnotherOnlyTheToolThatIsInDispute) {
  ForgedNode forged(1u << 3);
  int poses = 0;
  ASSERT_TRUE(bench_.hold(NodeBench::kAbove, [&] {
    if (++poses % 50 == 0) bench_.send(forged.next());
    return bench_.status() && bench_.status()->tools_served == 1u;
  })) << bench_.node().messages();
  EXPECT_TRUE(bench_.press());
  EXPECT_TRUE(bench_.node().running());
  EXPECT_TRUE(bench_.status_fault("tool 3: left to another"));
}

TEST_P(HapticStrangersTest, NoStatusTakesAToolFromASettledNode) {
  const std::string kept = "tool 0: another haptic_node claims it";
  ForgedNode forged(1u << 0 | 1u << 3);
  int poses = 0;
  ASSERT_TRUE(is_settled());
  EXPECT_TRUE(bench_.press_outlives([&] {
    const std::string before = bench_.fault(kept);
    return bench_.hold(NodeBench::kPressed, [&] {
      if (++poses % 50 == 0) bench_.send(forged.next());
      return bench_.fault(kept) != before;
    });
  })) << bench_.node().messages();
  EXPECT_TRUE(bench_.node().running());
  EXPECT_EQ(bench_.status()->tools_served, 1u << 0 | 1u << 3);
}

msg::DeviceInfo device_of(double force_n, double stiffness_n_m = 1000) {
  msg::DeviceInfo info{};
  info.max_force_n = force_n;
  info.max_torque_nm = 1;
  info.max_stiffness_n_m = stiffness_n_m;
  return info;
}

// Weaker than the block when it is pressed.
constexpr double kWeak_n = 0.05;

TEST_P(HapticStrangersTest, ADevicesLimitOutlivesNonsense) {
  const auto is_refused = [&](const msg::DeviceInfo& info, const std::string& fault) {
    bench_.send(device_of(kWeak_n));  // the newest sample may be all that a reader sees
    return bench_.hold(NodeBench::kAbove, [&] {
      bench_.send(info);
      return bench_.status_fault(fault);
    });
  };
  ASSERT_TRUE(bench_.hold(NodeBench::kAbove, [&] { return bench_.force().has_value(); }));
  ASSERT_TRUE(is_refused(device_of(-1), "tool 0: DeviceInfo.max_force_n = -1"));
  ASSERT_TRUE(is_refused(device_of(kWeak_n, 5e-324), "tool 0: DeviceInfo.max_stiffness_n_m"));
  for (const double nonsense : {std::nan(""), -1.0, HUGE_VAL}) bench_.send(device_of(nonsense));
  EXPECT_TRUE(bench_.press([&] { return (bench_.force()->state & msg::FORCE_CLAMPED) != 0; }));
  EXPECT_LE(bench_.newton(), kWeak_n * (1 + kRelative));
}

TEST_P(HapticStrangersTest, AnotherDeviceInfoMayTightenALimitAndNeverLiftsIt) {
  bench_.send(device_of(kWeak_n));
  auto stranger =
      transport::Bus::open({.vendor = GetParam().second, .domain = bench_.domain(), .name = "a stranger"});
  auto infos = stranger->writer<msg::DeviceInfo>();
  infos->write(device_of(10));
  const auto is_held_at = [&](double limit_n) {
    return bench_.press([&] { return std::abs(bench_.newton() - limit_n) <= limit_n * kRelative; });
  };
  ASSERT_TRUE(is_held_at(kWeak_n));
  infos->write(device_of(kWeak_n / 2));
  EXPECT_TRUE(is_held_at(kWeak_n / 2));
  infos->write(device_of(10));  // it is heard: the one before was
  EXPECT_TRUE(is_held_at(kWeak_n));
  infos->write(device_of(kWeak_n / 2));
  EXPECT_TRUE(is_held_at(kWeak_n / 2));
  infos.reset();
  stranger.reset();
  EXPECT_TRUE(is_held_at(kWeak_n)) << "he left";
}

INSTANTIATE_TEST_SUITE_P(Vendors, HapticStrangersTest,
                         ::testing::Values(std::pair{"fast", transport::Vendor::kFast},
                                           std::pair{"cyclone", transport::Vendor::kCyclone},
                                           std::pair{"fast", transport::Vendor::kCyclone}),
                         [](const auto& test) {
                           return test.param.first +
                                  (test.param.second == transport::Vendor::kFast ? "ToFast" : "ToCyclone");
                         });

}  // namespace
}  // namespace omentum
