// An organ with masses in the whole loop: strokes come in, topologies and states go out.
#include "deform_node/deform_loop.h"

#include "files/whole_file.h"
#include "geometry/mesh_editor.h"
#include "tests/deform_node/rates.h"
#include "tests/support/block_scene.h"
#include "tests/support/fake_bus.h"
#include "tests/support/process.h"
#include "tests/support/staged_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::deform {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

class CutLoopTest : public testing::Test {
 protected:
  CutLoopTest() {
    options_.node.scene = block_.scene_with(
        "mesh = ", "model = \"tensor-mass\"\ncut_delay_s = 0\ncut_rate_per_s = 1e6\nmesh = ");
    start();
  }

  /// In place of the one that runs: it leaves, as a killed one does.
  void start() {
    node_.reset();
    bus_.take_all<msg::Topology>();
    node_ = std::make_unique<test::StagedLoop<DeformLoop>>(kRate_hz, options_, bus_.opener());
    node_->pass(1.1);
  }

  static msg::Edge edge_at(double y) { return {{0.05, y, 0.12}, {0.05, y, 0.04}}; }
  /// A hook goes through the upper half of the block, from one side to the other.
  void cut(std::uint64_t count) {
    msg::Contact contact{};
    contact.cutting = true;
    contact.cut_count = count;
    contact.seq = ++seq_;
    contact.cause = {.tool = 0, .seq = seq_, .stamp_ns = 5};
    contact.topology_version = newest_topology().version;
    contact.edge_before = edge_at(-0.01);
    contact.edge = edge_at(0.11);
    bus_.post(contact);
    node_->tick();
    contact.cutting = false;
    contact.seq = ++seq_;
    contact.edge_before = contact.edge;
    bus_.post(contact);
    node_->tick();
  }
  msg::Topology newest_topology() { return bus_.newest<msg::Topology>().value_or(msg::Topology{}); }
  void reset() {
    bus_.post(
        msg::SessionCommand{.order = ++orders_, .sender = 1, .command = msg::COMMAND_RESET, .argument = {}});
    node_->tick(2);
  }

  test::BlockScene block_{4};
  organ::Organ organ_ = block_.organ();
  test::FakeBus bus_;
  DeformOptions options_;
  std::unique_ptr<test::StagedLoop<DeformLoop>> node_;
  std::uint64_t seq_ = 0, orders_ = 0;
};

TEST_F(CutLoopTest, TimeThatAStallTookIsLivedThroughAfterwards) {
  const auto steps_with = [&](double stall_s) {
    start();
    node_->pace().stall(static_cast<std::int64_t>(1e9 * stall_s));
    node_->pass(0.5 - stall_s);
    EXPECT_EQ(node_->end(), "");
    return node_->loop().report()["steps"].get<int>();
  };
  EXPECT_NEAR(steps_with(0.06), steps_with(0), 1);
}

TEST_F(CutLoopTest, AStrokeBecomesATopologyAndAStateThatNumbersBaredNodes) {
  EXPECT_EQ(bus_.newest<msg::OrganState>()->node_count, organ_.surface.node.size());
  cut(1);
  const msg::Topology topology = newest_topology();
  EXPECT_GE(topology.version, 1u);
  EXPECT_FALSE(topology.last_removed.empty());
  EXPECT_EQ(topology.burnt_bits.size(), topology.removed_bits.size());
  geometry::MeshEditor editor(organ_.mesh, {.smallest_piece_m3 = 0, .uncut_surface = organ_.surface.node});
  editor.set_removed(topology.removed_bits);
  EXPECT_GT(editor.surface_nodes().size(), organ_.surface.node.size());
  const auto state = bus_.newest<msg::OrganState>();
  EXPECT_EQ(state->topology_version, topology.version);
  EXPECT_EQ(state->node_count, editor.surface_nodes().size());
  node_->pass(0.5);
  EXPECT_EQ(node_->end(), "");
  EXPECT_EQ(node_->loop().report()["removed_tetrahedra"], editor.removed_count());
  EXPECT_GT(node_->loop().report()["real_time_factor"], 0.5);
}

TEST_F(CutLoopTest, AResetIsAWholeOrganInAHigherVersionThatCanBeCutAgain) {
  cut(1);
  const msg::Topology before = newest_topology();
  reset();
  const msg::Topology whole = newest_topology();
  EXPECT_GT(whole.version, before.version);
  for (const std::uint8_t bits : whole.removed_bits) EXPECT_EQ(bits, 0);
  for (const std::uint8_t bits : whole.burnt_bits) EXPECT_EQ(bits, 0);
  EXPECT_EQ(bus_.newest<msg::OrganState>()->node_count, organ_.surface.node.size());
  cut(2);
  EXPECT_GT(newest_topology().version, whole.version);
  EXPECT_EQ(newest_topology().removed_bits, before.removed_bits);
  EXPECT_EQ(node_->end(), "");
}

TEST_F(CutLoopTest, APressedOrganYieldsAndTellsTheHandOfItsSurface) {
  msg::ToolPose pose{};
  pose.seq = 1;
  pose.valid = true;
  pose.position = {0.05, 0.05, 0.1};
  bus_.post(pose);
  node_->tick();
  const auto model = bus_.newest<msg::LocalModel>();
  ASSERT_TRUE(model.has_value());
  EXPECT_GT(model->nodes.size(), 3u);
  EXPECT_EQ(model->compliance.size(), 3 * model->nodes.size() * (3 * model->nodes.size() + 1) / 2);
  EXPECT_EQ(node_->end(), "");
}

class CutJournalLoopTest : public CutLoopTest {
 protected:
  CutJournalLoopTest() {
    options_.journal = block_.file("cuts.json");
    start();
  }
  /// What a node says first that is started now.
  msg::Topology topology_after_restart() {
    start();
    const auto told = bus_.take_all<msg::Topology>();
    return told.empty() ? msg::Topology{} : told.front();
  }
};

TEST_F(CutJournalLoopTest, ARestartedNodeGoesOnWithTheSameCutsAndVersions) {
  cut(1);
  const msg::Topology before = newest_topology();
  const std::size_t nodes = bus_.newest<msg::OrganState>()->node_count;
  const msg::Topology after = topology_after_restart();
  EXPECT_EQ(after.version, before.version);
  EXPECT_EQ(after.removed_bits, before.removed_bits);
  EXPECT_EQ(after.burnt_bits, before.burnt_bits);
  EXPECT_EQ(bus_.newest<msg::OrganState>()->topology_version, before.version);
  EXPECT_EQ(bus_.newest<msg::OrganState>()->node_count, nodes);
  reset();
  EXPECT_EQ(newest_topology().version, before.version + 1);
  EXPECT_EQ(node_->end(), "");
}

TEST_F(CutJournalLoopTest, AfterAResetARestartedNodeIsWholeInTheSameVersion) {
  cut(1);
  reset();
  const msg::Topology before = newest_topology();
  const msg::Topology after = topology_after_restart();
  EXPECT_EQ(after.version, before.version);
  EXPECT_THAT(after.removed_bits, Each(0));
  EXPECT_THAT(after.burnt_bits, Each(0));
}

TEST_F(CutJournalLoopTest, WhatCannotBeUsedLeavesAWholeOrganInAHigherVersionAndAFault) {
  cut(1);
  const msg::Topology before = newest_topology();
  node_.reset();
  std::filesystem::resize_file(options_.journal, std::filesystem::file_size(options_.journal) / 2);
  const msg::Topology after = topology_after_restart();
  EXPECT_GT(after.version, before.version);
  EXPECT_THAT(after.removed_bits, Each(0));
  EXPECT_EQ(node_->end(), "");
  EXPECT_THAT(node_->loop().report()["faults"].dump(), HasSubstr("journal cannot be used"));
  EXPECT_EQ(topology_after_restart().version, after.version) << "the journal is a whole one again";
}

// While a node stands by, the other one cuts on.
TEST_F(CutJournalLoopTest, WhoTakesOverGoesOnWithWhatTheOtherOneCut) {
  cut(1);
  const msg::Topology cut_by_other = newest_topology();
  const std::string journal = test::read_text(options_.journal);
  std::filesystem::remove(options_.journal);
  start();
  msg::NodeStatus other{};
  other.kind = msg::NODE_DEFORM;
  other.instance = 1;
  other.rate_hz = kRate_hz;
  for (int i = 0; i < 20; ++i) {
    other.ticks += 10;
    bus_.post(other);
    node_->tick(10);
  }
  files::write_whole(options_.journal, journal);
  bus_.take_all<msg::Topology>();
  node_->pass(3);
  EXPECT_EQ(newest_topology().version, cut_by_other.version);
  EXPECT_EQ(newest_topology().removed_bits, cut_by_other.removed_bits);
  EXPECT_EQ(node_->end(), "");
}

TEST_F(CutLoopTest, WithoutAJournalARestartedNodeBeginsWhole) {
  cut(1);
  start();
  EXPECT_EQ(newest_topology().version, 0u);
  EXPECT_THAT(newest_topology().removed_bits, Each(0));
}

}  // namespace
}  // namespace omentum::deform
