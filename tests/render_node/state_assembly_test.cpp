#include "render_node/state_assembly.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::render {
namespace {

constexpr double kReach_m = 1000;
constexpr std::uint32_t kNodes = 6, kBlocks = 3, kPerBlock = 2;

// Every value of the state is `value`.
msg::OrganState block(std::uint64_t seq, std::uint32_t number, float value) {
  msg::OrganState state{};
  state.seq = seq;
  state.stamp_ns = static_cast<std::int64_t>(1000 * seq);
  state.block = number;
  state.block_count = kBlocks;
  state.first = kPerBlock * number;
  state.node_count = kNodes;
  state.echoes = {{.tool = 0, .seq = 10 * seq, .stamp_ns = 7}};
  state.values.assign(3 * kPerBlock, value);
  return state;
}

struct Shown {
  std::vector<AssembledState> states;
  StateAssembly assembly{msg::KIND_SURFACE, {kNodes, kNodes}, kReach_m};
  StateAssembly::Outcome take(const msg::OrganState& block) {
    return assembly.take(block, [this](const AssembledState& s) { states.push_back(s); });
  }
};

TEST(StateAssembly, ShowsAStateOnceAllBlocksCameInAnyOrder) {
  Shown shown;
  for (const std::uint32_t b : {2u, 0u}) shown.take(block(1, b, 1));
  EXPECT_TRUE(shown.states.empty());
  shown.take(block(1, 1, 1));
  ASSERT_EQ(shown.states.size(), 1u);
  EXPECT_EQ(shown.states[0].missing_blocks, 0u);
  EXPECT_EQ(shown.states[0].values, std::vector<float>(3 * kNodes, 1));
  ASSERT_EQ(shown.states[0].echoes.size(), 1u);
  EXPECT_EQ(shown.states[0].echoes[0].seq, 10u);
}

TEST(StateAssembly, LostBlockKeepsItsOldValuesForOneState) {
  Shown shown;
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(1, b, 1));
  shown.take(block(2, 0, 2));
  shown.take(block(2, 2, 2));
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(3, b, 3));
  ASSERT_EQ(shown.states.size(), 3u);
  const AssembledState& holed = shown.states[1];
  EXPECT_EQ(holed.seq, 2u);
  EXPECT_EQ(holed.missing_blocks, 1u);
  EXPECT_EQ(holed.values.front(), 2);
  EXPECT_EQ(holed.values[3 * kPerBlock], 1) << "the lost block";
  EXPECT_EQ(holed.values.back(), 2);
  EXPECT_EQ(shown.states[2].values, std::vector<float>(3 * kNodes, 3));
}

TEST(StateAssembly, LateAndRepeatedBlocksChangeNothing) {
  Shown shown;
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(5, b, 5));
  EXPECT_EQ(shown.take(block(4, 1, 4)), StateAssembly::Outcome::kLate);
  EXPECT_EQ(shown.take(block(5, 1, 9)), StateAssembly::Outcome::kLate);
  EXPECT_EQ(shown.states.size(), 1u);
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(6, b, 6));
  EXPECT_EQ(shown.states.back().values, std::vector<float>(3 * kNodes, 6));
}

TEST(StateAssembly, RestartedWriterIsBelievedByItsStamp) {
  Shown shown;
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(500, b, 1));
  for (std::uint32_t b = 0; b < kBlocks; ++b) {
    msg::OrganState first = block(1, b, 2);
    first.stamp_ns = 600'000;
    shown.take(first);
  }
  ASSERT_EQ(shown.states.size(), 2u);
  EXPECT_EQ(shown.states.back().seq, 1u);
}

TEST(StateAssembly, RestartedMachineIsBelievedAfterPatience) {
  Shown shown;
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(100000, b, 1));
  std::uint64_t seq = 0;
  while (shown.states.size() < 2 && seq < 2 * StateAssembly::kPatience) {
    ++seq;
    for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(seq, b, 2));
  }
  EXPECT_LE(seq, StateAssembly::kPatience / kBlocks + 2);
}

TEST(StateAssembly, MisfitsAreRefusedWhole) {
  Shown shown;
  const auto refuses = [&](auto&& spoil) {
    msg::OrganState bad = block(1, 0, 1);
    spoil(bad);
    return shown.take(bad) == StateAssembly::Outcome::kMisfit;
  };
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.node_count = kNodes + 1; }));
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.kind = msg::KIND_TUBE; }));
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.block = kBlocks; }));
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.first = kNodes - 1; }));
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.first = 0xffffffff; }));
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.block_count = 0xffffffff; }));
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.values[1] = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refuses([](msg::OrganState& s) { s.values[2] = -1e30f; })) << "farther than it reaches";
  EXPECT_TRUE(shown.states.empty());
}

// A block of a state that has one more block than the others: what a cut bared.
msg::OrganState cut_block(std::uint64_t seq, std::uint32_t number, float value) {
  msg::OrganState state = block(seq, number, value);
  state.topology_version = 1;
  state.block_count = kBlocks + 1;
  state.node_count = kNodes + kPerBlock;
  return state;
}

TEST(StateAssembly, StatesGrowWithTheirTopology) {
  Shown shown{{}, {msg::KIND_SURFACE, {kNodes, kNodes + kPerBlock}, kReach_m}};
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(1, b, 1));
  for (std::uint32_t b = 0; b <= kBlocks; ++b) shown.take(cut_block(2, b, 2));
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(3, b, 3));
  ASSERT_EQ(shown.states.size(), 3u);
  EXPECT_EQ(shown.states[1].topology_version, 1u);
  EXPECT_EQ(shown.states[1].values, std::vector<float>(3 * (kNodes + kPerBlock), 2));
  EXPECT_EQ(shown.states[2].values, std::vector<float>(3 * kNodes, 3));
  EXPECT_EQ(shown.states[2].topology_version, 0u);
}

TEST(StateAssembly, AStateOfANewTopologyIsShownWholeOrNotAtAll) {
  Shown shown{{}, {msg::KIND_SURFACE, {kNodes, kNodes + kPerBlock}, kReach_m}};
  for (std::uint32_t b = 0; b < kBlocks; ++b) shown.take(block(1, b, 1));
  shown.take(cut_block(2, 0, 2));
  for (std::uint32_t b = 0; b <= kBlocks; ++b) shown.take(cut_block(3, b, 3));
  ASSERT_EQ(shown.states.size(), 2u) << "the lost blocks' old values were other nodes'";
  EXPECT_EQ(shown.states[1].seq, 3u);
  shown.take(cut_block(4, 0, 4));
  shown.take(cut_block(5, 0, 5));
  ASSERT_EQ(shown.states.size(), 3u) << "but now they are the same nodes'";
  EXPECT_EQ(shown.states[2].values.back(), 3);
}

TEST(StateAssembly, ABlockThatContradictsItsStateIsAMisfit) {
  Shown shown{{}, {msg::KIND_SURFACE, {kNodes, kNodes + kPerBlock}, kReach_m}};
  shown.take(block(1, 0, 1));
  EXPECT_EQ(shown.take(cut_block(1, kBlocks, 1)), StateAssembly::Outcome::kMisfit);
  msg::OrganState too_many = cut_block(2, 0, 1);
  ++too_many.node_count;
  EXPECT_EQ(shown.take(too_many), StateAssembly::Outcome::kMisfit) << "more than the mesh has";
}

TEST(StateAssembly, TheFirstStateOfATubeIsShownWholeOrNotAtAll) {
  // a lost block of places would be masses at the scene's origin
  std::vector<AssembledState> shown;
  StateAssembly tube(msg::KIND_TUBE, {kNodes, kNodes}, kReach_m);
  const auto take = [&](std::uint64_t seq, std::uint32_t number) {
    msg::OrganState places = block(seq, number, 1);
    places.kind = msg::KIND_TUBE;
    tube.take(places, [&](const AssembledState& state) { shown.push_back(state); });
  };
  take(1, 0);
  for (std::uint32_t b = 0; b < kBlocks; ++b) take(2, b);
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0].seq, 2u);
  take(3, 0);
  take(4, 0);
  EXPECT_EQ(shown.size(), 2u) << "from then on a lost block keeps its places for one state";
}

TEST(StateAssembly, TakesStatesOfItsOwnKindOnly) {
  StateAssembly tube(msg::KIND_TUBE, {kPerBlock, kPerBlock}, kReach_m);
  msg::OrganState state = block(1, 0, 1);
  state.block_count = 1;
  state.node_count = kPerBlock;
  EXPECT_EQ(tube.take(state, {}), StateAssembly::Outcome::kMisfit);
  state.kind = msg::KIND_TUBE;
  int shown = 0;
  EXPECT_EQ(tube.take(state, [&](const AssembledState&) { ++shown; }), StateAssembly::Outcome::kTaken);
  EXPECT_EQ(shown, 1);
}

TEST(MergeEchoes, TakesTheNewestOfEachTool) {
  const auto merged = merge_echoes({{{0, 5, 50}, {1, 9, 90}}, {{0, 6, 60}, {1, 8, 80}}, {}});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].seq, 6u);
  EXPECT_EQ(merged[1].seq, 9u);
}

// A status with more than its bound would be refused whole.
TEST(MergeEchoes, FitsAStatusWhateverIsEchoed) {
  std::vector<msg::Echo> first, second;
  for (std::uint32_t tool = 0; tool < msg::MAX_TOOLS; ++tool) {
    first.push_back({.tool = tool, .seq = 1, .stamp_ns = 1});
    second.push_back({.tool = 1000 + tool, .seq = 1, .stamp_ns = 1});
  }
  EXPECT_EQ(merge_echoes({first, second}).size(), msg::MAX_TOOLS);
}

}  // namespace
}  // namespace omentum::render
