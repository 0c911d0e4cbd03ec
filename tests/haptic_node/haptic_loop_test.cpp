// haptic_node's whole loop between a scripted bus and a scripted pace: poses in, forces, contacts and
// statuses out, tick by tick.
#include "tests/haptic_node/haptic_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <numeric>

namespace omentum::haptic {
namespace {

using haptic_test::HapticLoopTest;
using haptic_test::kAbove;
using haptic_test::kListens_s;
using haptic_test::kPressed;
using haptic_test::kRate_hz;
using haptic_test::kRelative;
using haptic_test::newton;
using haptic_test::Node;
using haptic_test::vector;
using testing::_;
using testing::Each;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(HapticLoopTest, ListensForASecondBeforeItAnswers) {
  bus_.watch<msg::ToolForce>();
  bus_.watch<msg::Contact>();
  bus_.watch<msg::NodeStatus>();
  const auto node = start();
  hold(*node, kAbove, 999);
  EXPECT_THAT(bus_.left_over(), IsEmpty());
  bus_.expect<msg::NodeStatus>(Field(&msg::NodeStatus::tools_served, 1u << 0 | 1u << 3));
  bus_.expect<msg::Contact>(Field(&msg::Contact::tool, 0u));
  bus_.expect<msg::Contact>(Field(&msg::Contact::tool, 3u));
  bus_.expect<msg::ToolForce>(Field(&msg::ToolForce::echo_seq, 1000u));
  hold(*node, kAbove, 1);
}

TEST_F(HapticLoopTest, EachPoseWakesATickThatAnswersIt) {
  const auto node = serving();
  const std::uint64_t woken = node->pace().woken();
  bus_.take_all<msg::ToolForce>();
  hold(*node, kAbove, 50);
  EXPECT_EQ(node->pace().woken(), woken + 50);
  const auto forces = bus_.take_all<msg::ToolForce>();
  ASSERT_THAT(forces, SizeIs(50));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    EXPECT_EQ(forces[i].echo_seq, seq_ - 49 + i);
    EXPECT_EQ(forces[i].echo_stamp_ns, node->pace().now_ns() - 1'000'000 * static_cast<int>(50 - i));
  }
}

TEST_F(HapticLoopTest, PressedTissueAnswersAndItsContactSumsUpToTheForce) {
  const auto node = pressing();
  bus_.take_all<msg::Contact>();
  bus_.take_all<msg::ToolForce>();
  hold(*node, kPressed, 8);
  const auto contact = last_of_tool<msg::Contact>(0);
  ASSERT_TRUE(contact);
  ASSERT_THAT(contact->nodes, testing::Not(IsEmpty()));
  EXPECT_THAT(contact->displacements, SizeIs(contact->nodes.size()));
  for (const msg::ToolForce& force : bus_.take_all<msg::ToolForce>()) {
    if (force.tick != contact->tick) continue;
    const Vec3 sum = std::accumulate(contact->forces.begin(), contact->forces.end(), Vec3(0, 0, 0),
                                     [](const Vec3& s, const msg::Vec3& f) { return Vec3(s + vector(f)); });
    EXPECT_EQ(force.state, 0u);
    EXPECT_GT(force.force.z, 0.1);
    EXPECT_LE((sum + vector(force.force)).norm(), kRelative * sum.norm());
    EXPECT_EQ(contact->cause.seq, force.echo_seq);
    return;
  }
  FAIL() << "no force of the contact's tick";
}

TEST_F(HapticLoopTest, StatusesTellThePoseThatWasAnswered) {
  const auto node = serving();
  hold(*node, kAbove, 100);
  const std::uint64_t told_from = seq_;
  hold(*node, kAbove, 200);
  const auto status = bus_.newest<msg::NodeStatus>();
  ASSERT_THAT(status->echoes, SizeIs(2));
  EXPECT_EQ(status->echoes[0].tool, 0u);
  EXPECT_GE(status->echoes[0].seq, told_from);
  EXPECT_LE(status->echoes[0].seq, seq_);
  EXPECT_EQ(status->kind, msg::NODE_HAPTIC);
  EXPECT_EQ(status->rate_hz, kRate_hz);
  EXPECT_EQ(status->missed, 0u);
}

// Force is in newtons, not in impulses: it does not depend on how often it is computed.
TEST_F(HapticLoopTest, AHeldTipFeelsTheSameAt300HzAndAt1000Hz) {
  const auto slow = pressing(300), fast = pressing(1000);
  hold(*fast, kPressed, 1);
  const double fast_n = newton(*bus_.newest<msg::ToolForce>());
  hold(*slow, kPressed, 1);
  const double slow_n = newton(*bus_.newest<msg::ToolForce>());
  EXPECT_GT(fast_n, 0.1);
  EXPECT_NEAR(slow_n, fast_n, 0.02 * fast_n);
}

TEST_F(HapticLoopTest, ASilentDeviceIsToldZeroLetsGoAndIsForgotten) {
  const auto node = pressing();
  bus_.take_all<msg::Contact>();
  bus_.take_all<msg::ToolForce>();
  node->tick(60);
  const auto decay = bus_.take_all<msg::ToolForce>();
  ASSERT_THAT(decay, testing::Not(IsEmpty()));
  EXPECT_EQ(newton(decay.back()), 0);
  EXPECT_TRUE(decay.back().state & msg::FORCE_STALE);
  for (std::size_t i = 1; i < decay.size(); ++i)
    EXPECT_LE(newton(decay[i]), newton(decay[i - 1]) + kRelative);
  EXPECT_THAT(last_of_tool<msg::Contact>(0)->nodes, IsEmpty());
  node->pass(1);
  bus_.take_all<msg::ToolForce>();
  node->pass(1);
  EXPECT_THAT(bus_.take_all<msg::ToolForce>(), IsEmpty());
}

TEST_F(HapticLoopTest, RubbishOnTheTopicIsAFaultAndNoForce) {
  const auto node = pressing();
  for (int i = 0; i < 300; ++i) {
    msg::ToolPose pose = pose_at(*node, kPressed);
    pose.position.x = std::nan("");
    bus_.post(pose);
    node->tick();
    const auto force = bus_.newest<msg::ToolForce>();
    ASSERT_TRUE(std::isfinite(newton(*force)));
  }
  EXPECT_EQ(newton(*bus_.newest<msg::ToolForce>()), 0);
  EXPECT_THAT(faults(), ElementsAre(StartsWith("tool 0: pose refused: not finite")));
}

TEST_F(HapticLoopTest, PauseDecaysToZeroAndStartFadesIn) {
  const auto node = pressing();
  const double pressed = newton(*bus_.newest<msg::ToolForce>());
  command(msg::COMMAND_PAUSE);
  hold(*node, kPressed, 30);
  auto force = bus_.newest<msg::ToolForce>();
  EXPECT_EQ(newton(*force), 0);
  EXPECT_TRUE(force->state & msg::FORCE_PAUSED);
  hold(*node, kPressed, 200);
  EXPECT_TRUE(bus_.newest<msg::NodeStatus>()->paused);
  command(msg::COMMAND_START);
  hold(*node, kPressed, 50);
  force = bus_.newest<msg::ToolForce>();
  EXPECT_TRUE(force->state & msg::FORCE_RAMP);
  EXPECT_LT(newton(*force), 0.5 * pressed);
  hold(*node, kPressed, 300);
  force = bus_.newest<msg::ToolForce>();
  EXPECT_EQ(force->state, 0u);
  EXPECT_NEAR(newton(*force), pressed, 0.02 * pressed);
}

TEST_F(HapticLoopTest, WhoJoinsAPausedSessionIsPausedUntilItIsStarted) {
  const auto node = start();
  msg::NodeStatus device{};
  device.kind = msg::NODE_DEVICE;
  device.instance = 1;
  device.paused = true;
  bus_.post(device);
  hold(*node, kAbove, 1300);
  EXPECT_TRUE(bus_.newest<msg::NodeStatus>()->paused);
  EXPECT_TRUE(bus_.newest<msg::ToolForce>()->state & msg::FORCE_PAUSED);
  command(msg::COMMAND_START);
  hold(*node, kAbove, 300);
  EXPECT_FALSE(bus_.newest<msg::NodeStatus>()->paused);
  EXPECT_EQ(bus_.newest<msg::ToolForce>()->state, 0u);
}

TEST_F(HapticLoopTest, ResetLetsGoOfTheTissue) {
  const auto node = pressing();
  command(msg::COMMAND_RESET);
  bus_.take_all<msg::Contact>();
  hold(*node, kPressed, 8);
  EXPECT_THAT(last_of_tool<msg::Contact>(0)->nodes, IsEmpty());
  EXPECT_EQ(newton(*bus_.newest<msg::ToolForce>()), 0);
}

TEST_F(HapticLoopTest, AFaultIsLatchedUntilAPersonClearsIt) {
  const auto node = serving();
  const Vec3 nowhere(1e200, 0, 0);  // a place that cannot be computed with
  hold(*node, nowhere, 100);
  EXPECT_TRUE(bus_.newest<msg::ToolForce>()->state & msg::FORCE_FAULT);
  hold(*node, kAbove, 500);
  EXPECT_TRUE(bus_.newest<msg::ToolForce>()->state & msg::FORCE_FAULT) << "it is well now, but who knows";
  command(msg::COMMAND_CLEAR_FAULT);
  hold(*node, kAbove, 300);
  EXPECT_EQ(bus_.newest<msg::ToolForce>()->state, 0u);
}

TEST_F(HapticLoopTest, LostAndReorderedPosesAreCountedAndNobodyLosesForce) {
  const auto node = pressing();
  const double pressed = newton(*bus_.newest<msg::ToolForce>());
  bus_.lose<msg::ToolPose>(3);
  hold(*node, kPressed, 10);
  bus_.swap_next_two<msg::ToolPose>();
  hold(*node, kPressed, 10);
  EXPECT_NEAR(newton(*bus_.newest<msg::ToolForce>()), pressed, 1e-3 * pressed);
  EXPECT_EQ(node->end(), "");
  const auto poses = node->loop().report()["poses"][0];
  EXPECT_GE(poses["lost"], 3);
  EXPECT_EQ(poses["refused"], 1) << "the one that was overtaken";
  EXPECT_EQ(poses["accepted"], seq_ - 3 - 1);
}

TEST_F(HapticLoopTest, AWriterThatRefusesCostsNoTickAndNoForce) {
  const auto node = pressing();
  const double pressed = newton(*bus_.newest<msg::ToolForce>());
  bus_.refuse_writes<msg::ToolForce>(true);
  bus_.refuse_writes<msg::Contact>(true);
  hold(*node, kPressed, 20);
  bus_.refuse_writes<msg::ToolForce>(false);
  bus_.refuse_writes<msg::Contact>(false);
  bus_.take_all<msg::ToolForce>();
  hold(*node, kPressed, 1);
  const auto forces = bus_.take_all<msg::ToolForce>();
  ASSERT_THAT(forces, SizeIs(1));
  EXPECT_NEAR(newton(forces[0]), pressed, 1e-3 * pressed);
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(HapticLoopTest, AWriterThatBlocksIsMissedTicksAndNoStepOfTheForce) {
  const auto node = pressing();
  const double pressed = newton(*bus_.newest<msg::ToolForce>());
  bool blocks = true;
  bus_.on_write<msg::ToolForce>([&](const msg::ToolForce&) {
    if (std::exchange(blocks, false)) node->pace().stall(15'000'000);  // the tool is not let go of yet
  });
  hold(*node, kPressed, 300);
  double before = pressed;
  for (const msg::ToolForce& force : bus_.take_all<msg::ToolForce>()) {
    EXPECT_LE(newton(force), pressed * 1.02);
    EXPECT_LE(newton(force) - before, 2 * (1 + kRelative)) << "2 kN/s at 1 kHz";
    before = newton(force);
  }
  EXPECT_NEAR(before, pressed, 0.02 * pressed);
  EXPECT_GE(bus_.newest<msg::NodeStatus>()->missed, 14u);
}

TEST_F(HapticLoopTest, WhatItsReadersLostIsReported) {
  const auto node = serving();
  bus_.reject<msg::ToolPose>(2);
  hold(*node, kAbove, 2);
  bus_.reader_status<msg::ToolPose>().deadline_missed = 5;
  bus_.reader_status<msg::ToolPose>().liveliness_lost = 1;
  bus_.reader_status<msg::ToolPose>().incompatible_qos = 4;
  EXPECT_EQ(node->end(), "");
  const auto link = node->loop().report()["pose_link"];
  EXPECT_EQ(link["rejected"], 2);
  EXPECT_EQ(link["deadline_missed"], 5);
  EXPECT_EQ(link["liveliness_lost"], 1);
  EXPECT_EQ(link["incompatible_qos"], 4);
}

TEST_F(HapticLoopTest, ReportsWhatWasFelt) {
  const auto node = pressing();
  bus_.post(block().info());
  const double pressed = newton(*bus_.newest<msg::ToolForce>());
  hold(*node, kPressed, 100);
  EXPECT_EQ(node->end(), "");
  const auto report = node->loop().report();
  EXPECT_EQ(report["loop"]["rate_hz"], kRate_hz);
  EXPECT_EQ(report["loop"]["ticks"], seq_);
  EXPECT_EQ(report["loop"]["missed"], 0);
  EXPECT_GT(report["contacts"]["ticks_in_contact"], 100);
  EXPECT_GT(report["contacts"]["nodes_max"], 0);
  EXPECT_GE(report["force_n"]["max"], 0.99 * pressed);
  EXPECT_GT(report["force_n"]["mean"], 0);
  EXPECT_THAT(report["faults"], IsEmpty()) << report["faults"];
}

TEST_F(HapticLoopTest, ItsLogIsALineForEachTick) {
  const test::ScratchFolder folder;
  options_.node.log = folder / "hand.csv";
  const auto node = serving();
  hold(*node, kAbove, 20);
  EXPECT_EQ(node->end(), "");
  EXPECT_NO_THROW(node->loop().require_written());
  const std::string lines = test::read_text(folder / "hand.csv");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'),
            1 + node->loop().report()["loop"]["ticks"].get<int>());
}

}  // namespace
}  // namespace omentum::haptic
