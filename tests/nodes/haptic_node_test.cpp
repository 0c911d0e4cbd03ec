// The real haptic_node, as a device and its neighbours see it: poses in, forces and contacts out, over either
// vendor.
#include "tests/nodes/haptic_bench.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace omentum {
namespace {

using geometry::Vec3;
using haptic_test::BlockScene;
using haptic_test::kRelative;
using haptic_test::NodeBench;
using haptic_test::vector;

class HapticNodeTest : public ::testing::TestWithParam<std::pair<std::string, transport::Vendor>> {
 protected:
  BlockScene block_;
  NodeBench bench_{block_, GetParam().first, GetParam().second};
};

TEST_P(HapticNodeTest, PressedTissueAnswersAndItsContactSumsUpToTheForce) {
  ASSERT_TRUE(bench_.press()) << bench_.node().messages();
  // a contact and an unaltered force of the same tick
  std::optional<msg::ToolForce> force;
  ASSERT_TRUE(bench_.press([&] {
    force = bench_.force();
    const auto contact = bench_.contact();
    if (force->state != 0 || force->force.z == 0) return false;
    if (!contact || contact->tick != force->tick || contact->nodes.empty()) return false;
    Vec3 sum = Vec3::Zero();
    for (const msg::Vec3& f : contact->forces) sum += vector(f);
    EXPECT_LE((sum + vector(force->force)).norm(), kRelative * sum.norm());
    EXPECT_EQ(contact->cause.seq, force->echo_seq);
    EXPECT_EQ(contact->displacements.size(), contact->nodes.size());
    return true;
  }));
  EXPECT_GT(force->force.z, 0);
  EXPECT_LE(force->echo_seq, bench_.seq());
}

TEST_P(HapticNodeTest, ASilentDeviceIsToldZeroAndTheTissueIsLetGo) {
  ASSERT_TRUE(bench_.press());
  EXPECT_TRUE(
      test::comes_true([&] { return bench_.newton() == 0 && (bench_.force()->state & msg::FORCE_STALE); }));
  EXPECT_TRUE(test::comes_true([&] { return bench_.contact() && bench_.contact()->nodes.empty(); }));
}

TEST_P(HapticNodeTest, RubbishOnTheTopicIsAFaultAndNoForce) {
  ASSERT_TRUE(bench_.press());
  msg::ToolPose pose{};
  pose.valid = true;
  pose.orientation.w = 1;
  pose.position.x = std::nan("");
  for (int i = 0; i < 300; ++i) {
    pose.seq = bench_.seq() + 1;
    bench_.send(pose);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(std::isfinite(bench_.newton()));
  }
  EXPECT_TRUE(test::comes_true([&] { return bench_.newton() == 0; }));
  EXPECT_TRUE(test::comes_true([&] { return bench_.status_fault("tool 0: pose refused: not finite"); }));
}

TEST_P(HapticNodeTest, PauseIsZeroAndStartFadesIn) {
  ASSERT_TRUE(bench_.press());
  bench_.command(msg::COMMAND_PAUSE);
  EXPECT_TRUE(bench_.hold(NodeBench::kPressed, [&] {
    const auto status = bench_.status();
    return bench_.newton() == 0 && (bench_.force()->state & msg::FORCE_PAUSED) && status && status->paused;
  }));
  bench_.command(msg::COMMAND_START);
  EXPECT_TRUE(
      bench_.hold(NodeBench::kPressed, [&] { return (bench_.force()->state & msg::FORCE_RAMP) != 0; }));
  EXPECT_TRUE(bench_.press());
}

TEST_P(HapticNodeTest, ResetLetsGoOfTheTissue) {
  ASSERT_TRUE(bench_.press());
  bench_.command(msg::COMMAND_RESET);
  EXPECT_TRUE(bench_.hold(NodeBench::kAbove, [&] {
    return bench_.contact() && bench_.contact()->nodes.empty() && bench_.newton() == 0;
  }));
}

TEST_P(HapticNodeTest, TheDevicesLimitHolds) {
  msg::DeviceInfo info{};
  info.name = "a weak device";
  info.max_force_n = 0.05;
  info.max_torque_nm = 1;
  info.max_stiffness_n_m = 1000;
  bench_.send(info);
  EXPECT_TRUE(bench_.press([&] { return (bench_.force()->state & msg::FORCE_CLAMPED) != 0; }));
  EXPECT_LE(bench_.newton(), 0.05 * (1 + kRelative));
}

// A device tells that the session is paused; the node that starts, or starts again, finds it so.
TEST_P(HapticNodeTest, WhoJoinsAPausedSessionIsPaused) {
  msg::NodeStatus device{};
  device.kind = msg::NODE_DEVICE;
  device.instance = 1;
  device.paused = true;
  bench_.send(device);
  ASSERT_TRUE(bench_.hold(NodeBench::kAbove, [&] { return bench_.status() && bench_.status()->paused; }));
  EXPECT_TRUE(bench_.hold(NodeBench::kAbove, [&] {
    return bench_.force() && (bench_.force()->state & msg::FORCE_PAUSED) && bench_.newton() == 0;
  }));
  bench_.command(msg::COMMAND_START);
  EXPECT_TRUE(bench_.hold(NodeBench::kAbove, [&] { return !bench_.status()->paused; }));
}

TEST_P(HapticNodeTest, EndsCleanlyWithItsReport) {
  bench_.send(block_.info(block_.organ_hash()));
  ASSERT_TRUE(bench_.press());
  const double pressed = bench_.newton();
  EXPECT_EQ(bench_.node().terminate(), 0) << bench_.node().messages();
  const auto report = nlohmann::json::parse(test::read_text(block_.report()));
  EXPECT_EQ(report["dds"], GetParam().first);
  EXPECT_EQ(report["loop"]["rate_hz"], 1000);
  EXPECT_GT(report["loop"]["ticks"], 0);
  EXPECT_GT(report["contacts"]["ticks_in_contact"], 0);
  EXPECT_GT(report["contacts"]["nodes_max"], 0);
  EXPECT_GE(report["force_n"]["max"], 0.9 * pressed);
  EXPECT_GT(report["force_n"]["mean"], 0);
  // a busy machine delays this device's poses, and the node says so
  const std::string slow = "tool 0: poses come less than 40 times a second";
  for (const std::string fault : report["faults"]) EXPECT_TRUE(fault.starts_with(slow)) << fault;
}

INSTANTIATE_TEST_SUITE_P(Vendors, HapticNodeTest,
                         ::testing::Values(std::pair{"fast", transport::Vendor::kFast},
                                           std::pair{"cyclone", transport::Vendor::kCyclone},
                                           std::pair{"fast", transport::Vendor::kCyclone}),
                         [](const auto& test) {
                           return test.param.first +
                                  (test.param.second == transport::Vendor::kFast ? "ToFast" : "ToCyclone");
                         });

/// At the pressed place, N, of the first unaltered answer to a pose there; 0 when none came. Then up again.
double felt_n(NodeBench& bench) {
  double force_n = 0;
  static_cast<void>(bench.press([&] {
    const msg::ToolForce force = *bench.force();
    if (force.state == 0) force_n = vector(force.force).norm();
    return force_n > 0;
  }));
  bench.move(NodeBench::kAbove);
  return force_n;
}

// Force is in newtons, not in impulses: it does not depend on how often it is computed. The tip is held, it
// does not yield; where a busy machine made the node lose it, it is pressed again. (Whole scripts of hands
// that yield: haptic_scene_test.cpp.)
TEST(HapticNodeRate, AHeldTipFeelsTheSameAt300HzAndAt1000Hz) {
  constexpr double kWithin = 0.02, kFelt_n = 0.1;  // the issue's
  const BlockScene block;
  NodeBench slow(block, "cyclone", transport::Vendor::kCyclone, 300);
  NodeBench fast(block, "cyclone", transport::Vendor::kCyclone, 1000);
  double slow_n = 0, fast_n = 0;
  const bool agreed = test::comes_true([&] {
    slow_n = felt_n(slow), fast_n = felt_n(fast);
    return fast_n > kFelt_n && std::abs(slow_n - fast_n) <= kWithin * fast_n;
  });
  EXPECT_TRUE(agreed) << slow_n << " N at 300 Hz, " << fast_n << " N at 1000 Hz";
}

// What no node obeys must not look as if it had been done.
TEST(SessionProgram, RecordIsRefusedUntilItExists) {
  test::Process command("omentum_session", {"record"});
  EXPECT_EQ(command.wait(), 2);
  EXPECT_TRUE(command.messages().starts_with("omentum_session: ")) << command.messages();
  EXPECT_NE(command.messages().find("record"), std::string::npos) << command.messages();
}

TEST(HapticNodeStart, BadInputIsOneLineAndExitCodeTwo) {
  const test::ScratchFolder folder;
  const std::string organ =
      "name = \"n\"\n[[organs]]\nname = \"o\"\nmesh = \"m.msh\"\nyoung_pa = 1\n"
      "poisson = 0.3\ndensity_kg_m3 = 1\nfixed = \"plane:z<0\"\n";
  std::ofstream(folder / "broken.toml") << "name = \n";
  std::ofstream(folder / "no_file.toml")
      << organ << "[[tools]]\nid = 0\nname = \"p\"\nshape = \"probe\"\npoints = [[0,0,0]]\n";
  std::ofstream(folder / "broken.h5") << "not an organ";
  const std::string good = folder / "no_file.toml";
  const std::vector<std::vector<std::string>> table = {
      {"--scene", folder / "missing.toml"},
      {"--scene", folder / "broken.toml"},
      {"--scene", good},
      {"--scene", good, "--organ", folder / "missing.h5"},
      {"--scene", good, "--organ", folder / "broken.h5"},
      {"--scene", good, "--dds", "telepathy"},
      {"--scene", good, "--domain", "231"},
      {"--scene", good, "--rate-hz", "-1"},
      {},
  };
  for (const auto& arguments : table) {
    test::Process node("haptic_node", arguments);
    EXPECT_EQ(node.wait(), 2) << (arguments.empty() ? "no arguments" : arguments.back());
    const std::string messages = node.messages();
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1) << messages;
    EXPECT_TRUE(messages.starts_with("haptic_node: ")) << messages;
  }
}

}  // namespace
}  // namespace omentum
