// deform_node's whole loop between a scripted bus and a scripted pace.
#include "deform_node/deform_loop.h"

#include "tests/nodes/deform_push.h"
#include "tests/support/block_scene.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::deform {
namespace {

using deform_test::difference_from_plain_sum;
using deform_test::kWithin;
using deform_test::largest;
using deform_test::push;
using testing::_;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr double kRate_hz = 100;
constexpr double kListens_s = 1;
constexpr double kSettled_s = 5.5;  // half a second more than node::kSettled_s

class DeformLoopTest : public testing::Test {
 protected:
  using Node = test::StagedLoop<DeformLoop>;

  static void SetUpTestSuite() {
    block_ = std::make_unique<test::BlockScene>(4);
    organ_ = std::make_unique<organ::Organ>(block_->organ());
  }
  static void TearDownTestSuite() {
    organ_.reset();
    block_.reset();
  }

  std::unique_ptr<Node> start() {
    DeformOptions options;
    options.node.scene = block_->scene();
    return std::make_unique<Node>(kRate_hz, options, bus_.opener());
  }
  /// One that has served for a tick.
  std::unique_ptr<Node> serving() {
    auto node = start();
    node->pass(kListens_s);
    return node;
  }
  /// The state of the next tick.
  msg::OrganState next_state(Node& node) {
    bus_.take_all<msg::OrganState>();
    node.tick();
    const auto states = bus_.take_all<msg::OrganState>();
    EXPECT_THAT(states, SizeIs(1));
    return states.empty() ? msg::OrganState{} : states.front();
  }
  void command(std::uint32_t command) {
    bus_.post(msg::SessionCommand{.seq = ++commands_, .command = command, .argument = {}});
  }
  msg::NodeStatus status_of(std::uint32_t kind, std::uint64_t instance) {
    msg::NodeStatus status{};
    status.kind = kind;
    status.instance = instance;
    status.rate_hz = kRate_hz;
    return status;
  }
  /// A second in which another deform_node, older than any, tells ten times that it serves.
  void pass_beside_another(Node& node) {
    for (int i = 0; i < 10; ++i) {
      other_.ticks += 10;
      bus_.post(other_);
      node.tick(10);
    }
  }

  static std::unique_ptr<test::BlockScene> block_;
  static std::unique_ptr<organ::Organ> organ_;
  test::FakeBus bus_;
  std::uint64_t commands_ = 0;
  msg::NodeStatus other_ = status_of(msg::NODE_DEFORM, 1);
};
std::unique_ptr<test::BlockScene> DeformLoopTest::block_;
std::unique_ptr<organ::Organ> DeformLoopTest::organ_;

msg::SceneInfo scene_with(const std::string& hash) {
  return {.protocol = msg::PROTOCOL_VERSION, .scene = "s", .organs = {{.name = "o", .hash = hash}}};
}

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
            Field(&msg::SceneInfo::organs, ElementsAre(Field(&msg::OrganInfo::hash, block_->organ_hash())))));
  bus_.expect<msg::Topology>(AllOf(Field(&msg::Topology::version, 0u),
                                   Field(&msg::Topology::tetrahedron_count, organ_->mesh.tetrahedra.size())));
  bus_.expect<msg::OrganState>(Field(&msg::OrganState::seq, 1u));
  bus_.expect<msg::NodeStatus>(Field(&msg::NodeStatus::kind, msg::NODE_DEFORM));
  node->tick();
}

TEST_F(DeformLoopTest, AContactIsAStateInTheSameTickAndItsEchoIsTold) {
  const auto node = serving();
  const msg::Contact contact = push(*organ_, 7);
  bus_.post(contact);
  const msg::OrganState state = next_state(*node);
  ASSERT_EQ(state.values.size(), 3u * static_cast<std::size_t>(organ_->surface.node_count()));
  EXPECT_GT(largest(state), 1e-4);
  EXPECT_LE(difference_from_plain_sum(*organ_, contact, state), kWithin * largest(state));
  EXPECT_THAT(state.echoes, ElementsAre(contact.cause));
  EXPECT_EQ(state.stamp_ns, node->pace().now_ns());
  node->tick(10);
  EXPECT_THAT(bus_.newest<msg::NodeStatus>()->echoes, ElementsAre(contact.cause));
}

TEST_F(DeformLoopTest, ASilentSendersContactFadesToRest) {
  const auto node = serving();
  bus_.post(push(*organ_, 1));
  const double pressed = largest(next_state(*node));
  node->pass(kContactStaleS - 0.02);
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
  bus_.post(push(*organ_, 1));
  EXPECT_GT(largest(next_state(*node)), 0);
  command(msg::COMMAND_RESET);
  EXPECT_EQ(largest(next_state(*node)), 0);
  EXPECT_EQ(largest(next_state(*node)), 0);
  bus_.post(push(*organ_, 2));
  EXPECT_GT(largest(next_state(*node)), 0);
}

TEST_F(DeformLoopTest, PausedItKeepsItsShapeAndGoesOnPublishing) {
  const auto node = serving();
  bus_.post(push(*organ_, 1));
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
  msg::SceneInfo foreign = scene_with(block_->organ_hash());
  foreign.protocol = 99;
  for (const auto& [scene, why] : {std::pair(scene_with("abc"), "abc"), std::pair(foreign, "99")}) {
    const auto node = start();
    node->tick(10);
    bus_.post(scene);
    EXPECT_FALSE(node->tick());
    EXPECT_THAT(node->end(), HasSubstr(why));
    bus_.leave<msg::SceneInfo>();
  }
}

TEST_F(DeformLoopTest, ASceneThatWasThereBeforeIsNotJoinedEither) {
  bus_.post(scene_with("abc"));
  const auto node = start();
  EXPECT_THAT(node->end(), AllOf(HasSubstr("abc"), HasSubstr(block_->organ_hash())));
}

TEST_F(DeformLoopTest, ALateStrangersSceneIsAFaultAndNoEnd) {
  const auto node = start();
  node->pass(kSettled_s);
  bus_.post(scene_with("abc"));
  EXPECT_TRUE(node->tick(10));
  EXPECT_THAT(bus_.newest<msg::NodeStatus>()->faults, ElementsAre(StartsWith(node::kForeignScene)));
  EXPECT_EQ(node->end(), "");
}

TEST_F(DeformLoopTest, StandsByBesideAnotherOneAndTakesOverWhenItFallsSilent) {
  bus_.watch<msg::SceneInfo>();
  bus_.watch<msg::OrganState>();
  bus_.post(scene_with(block_->organ_hash()));
  const auto node = start();
  for (int second = 0; second < 4; ++second) pass_beside_another(*node);
  EXPECT_THAT(bus_.left_over(), IsEmpty()) << "it is silent";
  node->tick(90);  // the newest status came ten ticks before
  EXPECT_THAT(bus_.left_over(), IsEmpty()) << "the other one may only be late";
  bus_.expect<msg::SceneInfo>(_);
  node->tick();
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), SizeIs(1));
  EXPECT_EQ(node->end(), "");
}

TEST_F(DeformLoopTest, ContactsThatCameWhileItStoodByAreThereWhenItTakesOver) {
  const auto node = start();
  for (int second = 0; second < 2; ++second) pass_beside_another(*node);
  node->tick(90);
  bus_.post(push(*organ_, 5));
  node->tick(5);
  EXPECT_GT(largest(*bus_.newest<msg::OrganState>()), 0);
}

TEST_F(DeformLoopTest, AServingNodeStepsBackOnlyForAClaimThatIsRepeated) {
  const auto node = serving();
  other_.ticks = 1'000'000;
  bus_.post(other_);
  ++other_.ticks;
  bus_.post(other_);
  node->tick(10);
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), SizeIs(11)) << "two samples prove nothing";
  pass_beside_another(*node);
  bus_.take_all<msg::OrganState>();
  pass_beside_another(*node);
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), IsEmpty());
  EXPECT_THAT(node->loop().report()["faults"].dump(), HasSubstr("left to it"));
}

/// Two of them, each with a pace of its own, tick by tick in turns.
class DeformPairTest : public DeformLoopTest {
 protected:
  /// In how many of the last second's ticks each of them published.
  std::pair<int, int> live(double seconds) {
    int of_one = 0, of_two = 0;
    for (int k = 0; k < std::lround(seconds * kRate_hz); ++k) {
      const bool counts = k >= std::lround((seconds - 1) * kRate_hz);
      bus_.take_all<msg::OrganState>();
      one_->tick();
      if (!bus_.take_all<msg::OrganState>().empty() && counts) ++of_one;
      two_->tick();
      if (!bus_.take_all<msg::OrganState>().empty() && counts) ++of_two;
    }
    return {of_one, of_two};
  }

  std::unique_ptr<Node> one_, two_;
};

TEST_F(DeformPairTest, OfTwoThatStartTogetherTheOlderServes) {
  one_ = start();
  two_ = start();
  EXPECT_EQ(live(3), std::pair(100, 0));
  EXPECT_EQ(one_->end(), "");
  EXPECT_EQ(two_->end(), "");
}

TEST_F(DeformPairTest, TheSecondTakesOverFromOneThatEndedHoweverItEnded) {
  one_ = start();
  one_->pass(8);
  two_ = start();
  EXPECT_EQ(live(3), std::pair(100, 0));
  one_->end();
  two_->pass(1.2);
  bus_.take_all<msg::OrganState>();
  two_->pass(1);
  EXPECT_THAT(bus_.take_all<msg::OrganState>(), SizeIs(100));
}

// A laptop's lid: the other one has served meanwhile, and both think that the scene is theirs.
TEST_F(DeformPairTest, WhoWasFrozenAndWhoTookOverAreOneThatServes) {
  one_ = start();
  one_->pass(8);
  two_ = start();
  live(3);
  two_->pass(10);
  one_->pace().stall(10'000'000'000);
  const auto [of_one, of_two] = live(4);
  EXPECT_TRUE((of_one == 100 && of_two == 0) || (of_one == 0 && of_two == 100)) << of_one << ' ' << of_two;
  EXPECT_EQ(one_->end(), "");
  EXPECT_EQ(two_->end(), "");
}

TEST_F(DeformLoopTest, ContactsThatAreNoneAreFaultsAndMoveNothing) {
  const auto node = serving();
  msg::Contact cut = push(*organ_, 1), strong = push(*organ_, 2), foreign = push(*organ_, 3);
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
  bus_.post(push(*organ_, 1));
  EXPECT_EQ(largest(next_state(*node)), 0);
  bus_.post(push(*organ_, 2));
  EXPECT_THAT(next_state(*node).echoes, ElementsAre(Field(&msg::Echo::seq, 2u)));
}

TEST_F(DeformLoopTest, AWriterThatRefusesDelaysNoStep) {
  const auto node = serving();
  bus_.refuse_writes<msg::OrganState>(true);
  bus_.post(push(*organ_, 1));
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
  msg::Contact bad = push(*organ_, 1);
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
