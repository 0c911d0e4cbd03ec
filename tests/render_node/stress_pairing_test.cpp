// Values of one state are never shown with another one.
#include "render_node/stress_pairing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace omentum::render {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kPairedNodes = 4, kMostNodes = 6;
constexpr std::int64_t kTick_ns = 10'000'000;

class StressPairingTest : public testing::Test {
 protected:
  static AssembledState state(std::uint64_t seq, std::uint64_t version = 0,
                              std::size_t nodes = kPairedNodes) {
    AssembledState state;
    state.seq = seq;
    state.topology_version = version;
    state.values.assign(3 * nodes, static_cast<float>(seq));
    return state;
  }
  static msg::OrganStress block(std::uint64_t seq, std::uint32_t number = 0, std::uint32_t count = 1) {
    msg::OrganStress block{};
    block.seq = seq;
    block.block = number;
    block.block_count = count;
    block.node_count = kPairedNodes;
    const std::size_t in_block = kPairedNodes / count;
    block.first = static_cast<std::uint32_t>(in_block * number);
    block.strains.assign(in_block, static_cast<float>(seq));
    block.stresses.assign(in_block, 100.0f * static_cast<float>(seq));
    return block;
  }
  /// State `seq`, a tick after the one before; whether it is shown at once.
  std::optional<AssembledState> hear(std::uint64_t seq) {
    now_ns_ += kTick_ns;
    return check(pairing_.take(state(seq), now_ns_));
  }
  std::optional<AssembledState> hear(const msg::OrganStress& block) {
    EXPECT_TRUE(pairing_.take(block));
    return check(pairing_.pair(now_ns_));
  }
  static std::optional<AssembledState> check(std::optional<AssembledState> shown) {
    if (shown && !shown->strain.empty()) {
      EXPECT_THAT(shown->values, Each(shown->seq));
      EXPECT_THAT(shown->strain, Each(shown->seq));
    }
    return shown;
  }
  static bool is_pair(const std::optional<AssembledState>& shown, std::uint64_t seq) {
    return shown && shown->seq == seq && shown->strain.size() == kPairedNodes;
  }

  StressPairing pairing_{kMostNodes};
  std::int64_t now_ns_ = 0;
};

TEST_F(StressPairingTest, UntilValuesComeStatesAreShownWithout) {
  for (std::uint64_t seq = 1; seq <= 3; ++seq) {
    const auto shown = hear(seq);
    ASSERT_TRUE(shown);
    EXPECT_THAT(shown->strain, IsEmpty());
  }
  EXPECT_TRUE(is_pair(hear(block(3)), 3)) << "the first pair is shown at once";
}

TEST_F(StressPairingTest, ThenAStateWaitsForItsOwn) {
  hear(1);
  hear(block(1));
  EXPECT_FALSE(hear(2));
  EXPECT_FALSE(hear(block(1))) << "those of the state before";
  const auto shown = hear(block(2));
  ASSERT_TRUE(is_pair(shown, 2));
  EXPECT_THAT(shown->stress_pa, Each(200.0f));
}

TEST_F(StressPairingTest, ValuesThatComeFirstWaitForTheirState) {
  hear(1);
  hear(block(1));
  EXPECT_FALSE(hear(block(2)));
  EXPECT_TRUE(is_pair(hear(2), 2));
}

TEST_F(StressPairingTest, ValuesThatLagBehindShowTheOlderPair) {
  hear(1);
  hear(block(1));
  for (std::uint64_t seq = 2; seq <= 9; ++seq) EXPECT_FALSE(hear(seq));
  EXPECT_TRUE(is_pair(hear(block(5)), 5));
  EXPECT_TRUE(is_pair(hear(block(9)), 9));
  EXPECT_FALSE(hear(block(7))) << "the picture does not go back";
}

TEST_F(StressPairingTest, WhoHasSeenANewerStateDoesNotGoBackForTheFirstPair) {
  for (std::uint64_t seq = 1; seq <= 3; ++seq) hear(seq);
  EXPECT_FALSE(hear(block(2)));
  EXPECT_FALSE(hear(4)) << "from here on states wait";
  EXPECT_TRUE(is_pair(hear(block(4)), 4));
}

TEST_F(StressPairingTest, WhereValuesFallSilentTheStatesGoOnWithout) {
  hear(1);
  hear(block(1));
  int held = 0;
  std::uint64_t seq = 2;
  while (!hear(seq++)) ++held;
  EXPECT_NEAR(held, StressPairing::kPatience_ns / kTick_ns, 1);
  EXPECT_TRUE(hear(seq++));
  EXPECT_TRUE(is_pair(hear(block(seq - 1)), seq - 1)) << "and with them again when they are back";
}

TEST_F(StressPairingTest, EveryBlockIsNeeded) {
  hear(1);
  EXPECT_FALSE(hear(block(1, 1, 2)));
  EXPECT_FALSE(hear(block(1, 1, 2))) << "the same again";
  EXPECT_TRUE(is_pair(hear(block(1, 0, 2)), 1));
  EXPECT_FALSE(hear(2));
  EXPECT_FALSE(hear(block(2, 0, 2)));
  EXPECT_FALSE(hear(3));
  EXPECT_FALSE(hear(block(3, 1, 2))) << "one of each state";
  EXPECT_TRUE(is_pair(hear(block(3, 0, 2)), 3));
}

TEST_F(StressPairingTest, AnotherTopologyIsAnotherState) {
  hear(1);
  hear(block(1));
  EXPECT_FALSE(pairing_.take(state(2, 5), now_ns_));
  EXPECT_FALSE(hear(block(2)));
  msg::OrganStress of_version = block(2);
  of_version.topology_version = 5;
  EXPECT_TRUE(is_pair(hear(of_version), 2));
}

TEST_F(StressPairingTest, ARestartedSenderCountsAnew) {
  hear(1000);
  hear(block(1000));
  EXPECT_FALSE(hear(1));
  EXPECT_TRUE(is_pair(hear(block(1)), 1));
}

TEST_F(StressPairingTest, StrainAloneIsAPairToo) {
  msg::OrganStress alone = block(1);
  alone.stresses.clear();
  hear(1);
  const auto shown = hear(alone);
  ASSERT_TRUE(is_pair(shown, 1));
  EXPECT_THAT(shown->stress_pa, IsEmpty());
}

TEST_F(StressPairingTest, WhatIsNoneOfThisOrganIsRefused) {
  const auto refused = [&](const auto& spoil) {
    msg::OrganStress bad = block(1);
    spoil(bad);
    return !pairing_.take(bad);
  };
  EXPECT_TRUE(refused([](msg::OrganStress& s) { s.node_count = 7; }));
  EXPECT_TRUE(refused([](msg::OrganStress& s) { s.first = 1; }));
  EXPECT_TRUE(refused([](msg::OrganStress& s) { s.block = 1; }));
  EXPECT_TRUE(refused([](msg::OrganStress& s) { s.block_count = 1'000'000'000; }));
  EXPECT_TRUE(refused([](msg::OrganStress& s) { s.stresses.pop_back(); }));
  EXPECT_TRUE(refused([](msg::OrganStress& s) { s.strains[2] = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](msg::OrganStress& s) { s.stresses[0] = std::numeric_limits<float>::infinity(); }));
  hear(1);
  EXPECT_TRUE(is_pair(hear(block(1)), 1));
}

}  // namespace
}  // namespace omentum::render
