#include "deform_node/local_publisher.h"
#include "deform_node/state_publisher.h"
#include "node_common/loaded_scene.h"

#include "tests/deform_node/deform_toy.h"
#include "tests/deform_node/rates.h"
#include "tests/deform_node/written_messages.h"
#include "tests/support/heap_count.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

using deform_test::HangingMass;
using deform_test::Journal;
using deform_test::WrittenMessages;
using ::testing::ElementsAre;

constexpr std::int32_t kManyNodes = 1000;  // to a block
constexpr std::size_t kPatchNodes = 24;

class PublisherTest : public ::testing::Test {
 protected:
  PublisherTest() { organs_.push_back(deform_test::hanging_organ("toy")); }

  StatePublisher make_publisher(CutJournal* journal = nullptr) {
    scene::Scene scene;
    scene.name = "a toy";
    msg::NodeStatus introduction;
    introduction.kind = msg::NODE_DEFORM;
    introduction.instance = 7;
    return {{scenes_, topologies_, states_, statuses_, journal},
            organs_,
            kManyNodes,
            node::to_message(node::loaded_scene(scene, describe(organs_)), scene.name),
            introduction,
            faults_,
            runtime::on_own_thread};
  }
  HangingMass& mass() { return static_cast<HangingMass&>(*organs_[0].model); }
  void cut() {
    const CutStroke stroke;
    mass().step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  }
  /// State `seq`, with a status where `status` is new.
  void publish(StatePublisher& publisher, std::uint64_t seq, std::uint64_t status = 0) {
    TickSnapshot& tick = publisher.draft();
    tick.seq = seq;
    tick.stamp_ns = static_cast<std::int64_t>(seq);
    const msg::Echo echo{.tool = 0, .seq = 100 + seq, .stamp_ns = 5};
    tick.echoes.take({&echo, 1});
    tick.organs[0].take(mass().view());
    tick.figures = {.number = status, .paused = true, .ticks = 10 * seq};
    publisher.publish();
  }

  std::vector<ServedOrgan> organs_;
  runtime::FaultList faults_;
  Journal journal_;
  WrittenMessages<msg::SceneInfo> scenes_{"scene", &journal_};
  WrittenMessages<msg::Topology> topologies_{"topology", &journal_};
  WrittenMessages<msg::OrganState> states_{"state", &journal_};
  WrittenMessages<msg::NodeStatus> statuses_{"status", &journal_};
};

TEST_F(PublisherTest, SceneAndTopologyComeBeforeTheFirstStateAndItsStatusAfterIt) {
  faults_.raise("something");
  {
    StatePublisher publisher = make_publisher();
    publish(publisher, 1, 1);
  }
  EXPECT_THAT(journal_.lines(), ElementsAre("scene", "topology", "state", "status"));
  EXPECT_EQ(scenes_.all()[0].organs.at(0).name, "toy");
  const msg::OrganState state = states_.all()[0];
  EXPECT_EQ(state.kind, msg::KIND_TUBE);
  EXPECT_EQ(state.node_count, 1u);
  EXPECT_EQ(state.echoes.at(0).seq, 101u);
  const msg::NodeStatus status = statuses_.all()[0];
  EXPECT_EQ(status.instance, 7u);
  EXPECT_EQ(status.ticks, 10u);
  EXPECT_TRUE(status.paused);
  EXPECT_EQ(status.echoes.at(0).seq, 101u) << "of the state that was just written";
  EXPECT_EQ(status.faults.size(), 1u);
}

// Else two sets could have one version: the one that was told, and what a node cuts that is started again.
TEST_F(PublisherTest, WhatIsCutIsInTheJournalBeforeAnybodyIsTold) {
  const test::ScratchFolder folder;
  const JournalScene scene = journal_scene("hash", organs_);
  CutJournal journal(folder / "cuts.json", scene, faults_);
  topologies_.refuse(true);
  cut();
  {
    StatePublisher publisher = make_publisher(&journal);
    publish(publisher, 1);
  }
  EXPECT_TRUE(topologies_.all().empty());
  const OrganCuts kept = read_journal(folder / "cuts.json", scene).organs.at(0);
  EXPECT_EQ(kept.version, 1u);
  EXPECT_THAT(kept.removed_bits, ElementsAre(1, 0, 0));
}

TEST_F(PublisherTest, NothingIsWrittenBeforeTheLoopPublishes) {
  make_publisher();
  EXPECT_TRUE(journal_.lines().empty());
}

TEST_F(PublisherTest, AStuckWireDelaysNoStepAndThenTheNewestStateLeaves) {
  StatePublisher publisher = make_publisher();
  publish(publisher, 1);
  states_.await(1);
  states_.get_stuck();
  publish(publisher, 2);
  states_.await_begun(2);
  // these come back although nobody takes what they give
  for (std::uint64_t seq = 3; seq <= 1000; ++seq) publish(publisher, seq, seq == 500 ? 1 : 0);
  states_.come_free();
  const auto states = states_.await(3);
  EXPECT_EQ(states[1].seq, 2u);
  EXPECT_EQ(states[2].seq, 1000u) << "what nobody could have seen in time is passed over";
}

TEST_F(PublisherTest, AStatusIsNotLostWithTheStateThatItWasDueAt) {
  StatePublisher publisher = make_publisher();
  states_.get_stuck();
  publish(publisher, 1);
  states_.await_begun(1);
  publish(publisher, 2, 1);
  publish(publisher, 3, 1);
  states_.come_free();
  EXPECT_EQ(statuses_.await(1)[0].echoes.at(0).seq, 103u);
}

TEST_F(PublisherTest, PublishingTakesNoMemoryInTheLoop) {
  StatePublisher publisher = make_publisher();
  const std::size_t before = test::heap_allocations();
  for (std::uint64_t seq = 1; seq <= 20; ++seq) {
    cut();
    publish(publisher, seq, seq);
  }
  EXPECT_EQ(test::heap_allocations(), before);
}

TEST_F(PublisherTest, ACutOrgansTopologyComesBeforeItsState) {
  StatePublisher publisher = make_publisher();
  publish(publisher, 1);
  states_.await(1);
  for (int i = 0; i < 3; ++i) cut();
  publish(publisher, 2);
  states_.await(2);
  publish(publisher, 3);
  states_.await(3);
  EXPECT_THAT(journal_.lines(), ElementsAre("scene", "topology", "state", "topology", "state", "state"));
  const msg::Topology cut = topologies_.all()[1];
  EXPECT_EQ(cut.version, 3u);
  EXPECT_EQ(cut.tetrahedron_count, HangingMass::kTetrahedra);
  EXPECT_THAT(cut.removed_bits, ElementsAre(7, 0, 0));
  EXPECT_THAT(cut.last_removed, ElementsAre(0u, 1u, 2u));
  EXPECT_EQ(states_.all()[1].topology_version, 3u);
}

TEST_F(PublisherTest, AResetIsANewVersionOfAWholeOrgan) {
  StatePublisher publisher = make_publisher();
  cut();
  publish(publisher, 1);
  states_.await(1);
  mass().reset();
  publish(publisher, 2);
  states_.await(2);
  const msg::Topology whole = topologies_.all()[1];
  EXPECT_EQ(whole.version, 2u);
  EXPECT_THAT(whole.removed_bits, ElementsAre(0, 0, 0));
  EXPECT_TRUE(whole.last_removed.empty());
}

// A participant that joins its domain anew refuses for a while.
TEST_F(PublisherTest, WhatWasRefusedIsToldAgainAndNoStateLeavesBefore) {
  StatePublisher publisher = make_publisher();
  scenes_.refuse(true);
  topologies_.refuse(true);
  publish(publisher, 1);
  topologies_.await_begun(1);
  scenes_.refuse(false);
  topologies_.refuse(false);
  publish(publisher, 2);
  EXPECT_EQ(states_.await(1)[0].seq, 2u);
  EXPECT_THAT(journal_.lines(), ElementsAre("scene", "topology", "state"));
}

/// Tool 0 at the toy.
class LocalPublisherTest : public PublisherTest {
 protected:
  ToolPlace tool_at(const Vec3& tip) const { return {0, {0, tip, kPatchRadius_m}}; }
  void offer(LocalPublisher& publisher, const Vec3& tip, std::int64_t now_ns) {
    const ToolPlace place = tool_at(tip);
    publisher.offer({&place, 1}, {&echo_, 1}, now_ns);
  }
  const msg::Echo echo_{.tool = 0, .seq = 100, .stamp_ns = 5};
  WrittenMessages<msg::LocalModel> models_{"local", &journal_};
};

TEST_F(LocalPublisherTest, LargerModelsThanTheProfileCarriesAreRefusedAtTheStart) {
  EXPECT_THROW(LocalPublisher(models_, organs_, 0, runtime::on_own_thread), std::runtime_error);
}

TEST_F(LocalPublisherTest, AroundAToolLeavesWhatTheModelOffers) {
  ASSERT_TRUE(offers_local_models(organs_));
  LocalPublisher publisher(models_, organs_, kPatchNodes, runtime::on_own_thread);
  mass().push(Vec3(0, 0, 0.1));
  mass().step({}, kTick_s);
  offer(publisher, Vec3::Zero(), 77);
  const msg::LocalModel model = models_.await(1)[0];
  EXPECT_EQ(model.seq, 1u);
  EXPECT_EQ(model.stamp_ns, 77);
  ASSERT_EQ(model.echoes.size(), 1u);
  EXPECT_EQ(model.echoes[0].seq, 100u);
  ASSERT_EQ(model.positions.size(), 1u);
  EXPECT_DOUBLE_EQ(model.positions[0].z, mass().position().z());
  const float c = 1 / HangingMass::kSpring_n_m;
  EXPECT_THAT(model.compliance, ElementsAre(c, 0, 0, c, 0, c));
}

TEST_F(LocalPublisherTest, WithoutAToolNearNothingLeaves) {
  {
    LocalPublisher publisher(models_, organs_, kPatchNodes, runtime::on_own_thread);
    publisher.offer({}, {}, 1);
    offer(publisher, Vec3(1, 0, 0), 2);
  }
  EXPECT_TRUE(models_.all().empty());
}

// Else a hand would take the tissue that comes back for that which it touched.
TEST_F(LocalPublisherTest, OfAnOrganThatBeginsAnewThereIsNothingForAMoment) {
  LocalPublisher publisher(models_, organs_, kPatchNodes, runtime::on_own_thread);
  const auto nodes_at = [&](double time_s) {
    offer(publisher, Vec3::Zero(), std::llround(1e9 * time_s));
    return models_.await(models_.all().size() + 1).back().nodes.size();
  };
  EXPECT_EQ(nodes_at(1), 1u);
  ++organs_[0].begun_anew;
  EXPECT_EQ(nodes_at(1.01), 0u);
  EXPECT_EQ(nodes_at(1.01 + 0.9 * kUnfelt_s), 0u);
  EXPECT_EQ(nodes_at(1.01 + 1.1 * kUnfelt_s), 1u);
}

TEST_F(LocalPublisherTest, AStuckStateDelaysNoLocalModel) {
  StatePublisher states = make_publisher();
  LocalPublisher locals(models_, organs_, kPatchNodes, runtime::on_own_thread);
  states_.get_stuck();
  publish(states, 1);
  states_.await_begun(1);
  for (std::size_t i = 1; i <= 5; ++i) {
    publish(states, 1 + i);
    offer(locals, Vec3::Zero(), static_cast<std::int64_t>(i));
    EXPECT_EQ(models_.await(i).back().seq, i);
  }
  states_.come_free();
}

TEST_F(LocalPublisherTest, OfferingTakesNoMemory) {
  LocalPublisher publisher(models_, organs_, kPatchNodes, runtime::on_own_thread);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 50; ++i) offer(publisher, Vec3::Zero(), i);
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::deform
