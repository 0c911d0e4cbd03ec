// deform_node's whole loop between a scripted bus and a scripted pace.
#include "tests/deform_node/deform_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::deform {
namespace {

using deform_test::DeformLoopTest;
using deform_test::difference_from_plain_sum;
using deform_test::kListens_s;
using deform_test::kSettled_s;
using deform_test::kWithin;
using deform_test::largest;
using deform_test::push;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(DeformLoopTest, ListensForASecondThenSaysWhatItServes) {
  bus_.watch<msg::SceneInfo>();
  bus_.watch<msg::Topology>();
  bus_.watch<msg::OrganState>();
  bus_.watch<msg::NodeStatus>();
  const auto node = start();
  node->tick(99);
  EXPECT_THAT(bus_.left_over(), IsEmpty()) << "it only listens";
  bus_.expect<msg::SceneInfo>(
      AllOf(Field(&msg::SceneInfo::protocol, msg::PROTOCOL_VERSION), Field(&msg::SceneInfo::scene, "a block"),
            Field(&msg::SceneInfo::organs, ElementsAre(Field(&msg::OrganInfo::hash, block().organ_hash())))));
  bus_.expect<msg::Topology>(AllOf(Field(&msg::Topology::version, 0u),
                                   Field(&msg::Topology::tetrahedron_count, organ().mesh.tetrahedra.size())));
  bus_.expect<msg::OrganState>(Field(&msg::OrganState::seq, 1u));
  bus_.expect<msg::NodeStatus>(Field(&msg::NodeStatus::kind, msg::NODE_DEFORM));
  node->tick();
}

TEST_F(DeformLoopTest, AContactIsAStateInTheSameTickAndItsEchoIsTold) {
  const auto node = serving();
  const msg::Contact contact = push(organ(), 7);
  bus_.post(contact);
  const msg::OrganState state = next_state(*node);
  ASSERT_EQ(state.values.size(), 3u * static_cast<std::size_t>(organ().surface.node_count()));
  EXPECT_GT(largest(state), 1e-4);
  EXPECT_LE(difference_from_plain_sum(organ(), contact, state), kWithin * largest(state));
  EXPECT_THAT(state.echoes, ElementsAre(contact.cause));
  EXPECT_EQ(state.stamp_ns, node->pace().now_ns());
  node->tick(10);
  EXPECT_THAT(bus_.newest<msg::NodeStatus>()->echoes, ElementsAre(contact.cause));
}

TEST_F(DeformLoopTest, ASilentSendersContactFadesToRest) {
  const auto node = serving();
  bus_.post(push(organ(), 1));
  const double pressed = largest(next_state(*node));
  node->pass(kContactStale_s - 0.02);
  EXPECT_EQ(largest(next_state(*node)), pressed);
  double before = pressed;
  for (int k = 0; k < 29; ++k) {
    const double now = largest(next_state(*node));
    EXPECT_LE(now, before);
    before = now;
  }
  EXPECT_LT(before, 0.1 * pressed);
  node->pass(0.05);
  EXPECT_EQ(largest(next_state(*node)), 0);
}

TEST_F(DeformLoopTest, AResetIsAtOnceAndForgetsWhatCameBefore) {
  const auto node = serving();
  bus_.post(push(organ(), 1));
  EXPECT_GT(largest(next_state(*node)), 0);
  command(msg::COMMAND_RESET);
  EXPECT_EQ(largest(next_state(*node)), 0);
  EXPECT_EQ(largest(next_state(*node)), 0);
  bus_.post(push(organ(), 2));
  EXPECT_GT(largest(next_state(*node)), 0);
}

TEST_F(DeformLoopTest, PausedItKeepsItsShapeAndGoesOnPublishing) {
  const auto node = serving();
  bus_.post(push(organ(), 1));
  next_state(*node);
  command(msg::COMMAND_PAUSE);
  const msg::OrganState held = next_state(*node);
  node->pass(1);  // longer than a silent sender's contact lasts
  const msg::OrganState later = next_state(*node);
  EXPECT_EQ(later.values, held.values);
  EXPECT_EQ(later.seq, held.seq + 101);
  EXPECT_TRUE(bus_.newest<msg::NodeStatus>()->paused);
  command(msg::COMMAND_START);
  EXPECT_EQ(largest(next_state(*node)), 0);
}

TEST_F(DeformLoopTest, WhoJoinsAPausedSessionIsPausedUntilItIsStarted) {
  const auto node = start();
  auto device = status_of(msg::NODE_DEVICE, 1);
  device.paused = true;
  bus_.post(device);
  node->pass(kListens_s);
  EXPECT_TRUE(bus_.newest<msg::NodeStatus>()->paused);
  command(msg::COMMAND_START);
  node->tick(10);
  EXPECT_FALSE(bus_.newest<msg::NodeStatus>()->paused);
  node->pass(kSettled_s);
  bus_.post(device);
  node->tick(10);
  EXPECT_FALSE(bus_.newest<msg::NodeStatus>()->paused) << "it is no newcomer any more";
}

TEST_F(DeformLoopTest, ASceneWithAnotherOrganOrProtocolIsNotJoined) {
  bus_.watch<msg::SceneInfo>();
  bus_.watch<msg::OrganState>();
  msg::SceneInfo foreign = block().info();
  foreign.protocol = 99;
  for (const auto& [scene, why] : {std::pair(block().info("abc"), "abc"), std::pair(foreign, "99")}) {
    const auto node = start();
    node->tick(10);
    bus_.post(scene);
    EXPECT_FALSE(node->tick());
    EXPECT_THAT(node->end(), HasSubstr(why));
    bus_.leave<msg::SceneInfo>();
  }
}

TEST_F(DeformLoopTest, ASceneThatWasThereBeforeIsNotJoinedEither) {
  bus_.post(block().info("abc"));
  const auto node = start();
  EXPECT_THAT(node->end(), AllOf(HasSubstr("abc"), HasSubstr(block().organ_hash())));
}

TEST_F(DeformLoopTest, ALateStrangersSceneIsAFaultAndNoEnd) {
  const auto node = start();
  node->pass(kSettled_s);
  bus_.post(block().info("abc"));
  EXPECT_TRUE(node->tick(10));
  EXPECT_THAT(bus_.newest<msg::NodeStatus>()->faults, ElementsAre(StartsWith(node::kForeignScene)));
  EXPECT_EQ(node->end(), "");
}

TEST_F(DeformLoopTest, ContactsThatAreNoneAreFaultsAndMoveNothing) {
  const auto node = serving();
  msg::Contact cut = push(organ(), 1), strong = push(organ(), 2), foreign = push(organ(), 3);
  cut.topology_version = 5;
  strong.forces[0].z = -1e30;
  foreign.tool = foreign.cause.tool = 5;
  for (const msg::Contact& bad : {cut, strong, foreign}) bus_.post(bad);
  const msg::OrganState state = next_state(*node);
  EXPECT_EQ(largest(state), 0);
  EXPECT_THAT(state.echoes, IsEmpty());
  node->tick(10);
  EXPECT_THAT(bus_.newest<msg::NodeStatus>()->faults, SizeIs(3));
}

TEST_F(DeformLoopTest, ALostContactIsMadeUpForByTheNextOne) {
  const auto node = serving();
  bus_.lose<msg::Contact>(1);
  bus_.post(push(organ(), 1));
  EXPECT_EQ(largest(next_state(*node)), 0);
  bus_.post(push(organ(), 2));
  EXPECT_THAT(next_state(*node).echoes, ElementsAre(Field(&msg::Echo::seq, 2u)));
}

TEST_F(DeformLoopTest, AWriterThatRefusesDelaysNoStep) {
  const auto node = serving();
  bus_.refuse_writes<msg::OrganState>(true);
  bus_.post(push(organ(), 1));
  EXPECT_TRUE(node->tick(5));
  bus_.refuse_writes<msg::OrganState>(false);
  const msg::OrganState state = next_state(*node);
  EXPECT_EQ(state.seq, 7u) << "numbers count what was computed, so that a reader sees what is missing";
  EXPECT_GT(largest(state), 0);
}

TEST_F(DeformLoopTest, TicksThatTookTooLongAreMissedAndTold) {
  const auto node = serving();
  int slow = 3;
  bus_.on_write<msg::OrganState>([&](const msg::OrganState&) {
    if (slow-- > 0) node->pace().stall(40'000'000);  // a vendor that waits
  });
  node->tick(20);
  const auto status = bus_.newest<msg::NodeStatus>();
  EXPECT_GE(status->missed, 9u);
  EXPECT_GE(status->compute_us.max, 40e3 * 0.9);
}

TEST_F(DeformLoopTest, ReportsWhatItDid) {
  const auto node = serving();
  msg::Contact bad = push(organ(), 1);
  bad.organ = 9;
  bus_.post(bad);
  node->tick(49);
  command(msg::COMMAND_PAUSE);
  node->tick(50);
  EXPECT_EQ(node->end(), "");
  const auto report = node->loop().report();
  EXPECT_EQ(report["states"], 100);
  EXPECT_EQ(report["steps"], 50);
  EXPECT_EQ(report["removed_tetrahedra"], 0);
  EXPECT_EQ(report["loop"]["ticks"], 199);
  EXPECT_EQ(report["loop"]["rate_hz"], 100);
  EXPECT_THAT(report["faults"], SizeIs(1));
}

}  // namespace
}  // namespace omentum::deform
