#include "deform_node/local_model_message.h"
#include "deform_node/organ_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

using ::testing::ElementsAre;

constexpr std::uint32_t kTetrahedra = 10;
constexpr std::int32_t kMostNodes = 2;

TickSnapshot tick_of(const std::vector<float>& values) {
  TickSnapshot tick;
  OrganSnapshot& organ = tick.organs.emplace_back(ModelSizes{.values = 12, .removed_bytes = 2});
  organ.take({.values = values});
  return tick;
}

TEST(OrganSnapshot, KeepsWhatIsRemovedOnlyAsLongAsItsVersionStays) {
  OrganSnapshot snapshot(ModelSizes{.values = 3, .removed_bytes = 2});
  const std::vector<std::uint8_t> cut{0b101, 0b10};
  snapshot.take({.topology_version = 4, .values = {}, .removed_bits = cut});
  EXPECT_EQ(snapshot.removed_bits, cut);
  snapshot.take({.topology_version = 5, .values = {}});
  EXPECT_THAT(snapshot.removed_bits, ElementsAre(0, 0)) << "no bits are a whole organ";
}

TEST(OrganMessages, AStateIsCutIntoBlocksThatCoverIt) {
  OrganMessages messages(0, kTetrahedra, kMostNodes);
  const std::vector<float> values{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const auto& blocks = messages.blocks_of(tick_of(values));
  ASSERT_EQ(blocks.size(), 2u);
  std::vector<float> together;
  for (const msg::OrganState& block : blocks) {
    EXPECT_EQ(block.block_count, 2u);
    EXPECT_EQ(block.node_count, 3u);
    EXPECT_EQ(3 * block.first, together.size());
    together.insert(together.end(), block.values.begin(), block.values.end());
  }
  EXPECT_EQ(together, values);
}

TEST(OrganMessages, AStateThatGrowsIsCutAnew) {
  OrganMessages messages(0, kTetrahedra, kMostNodes);
  EXPECT_EQ(messages.blocks_of(tick_of({1, 2, 3})).size(), 1u);
  EXPECT_EQ(messages.blocks_of(tick_of(std::vector<float>(12, 1))).size(), 2u);
  EXPECT_EQ(messages.blocks_of(tick_of({})).front().node_count, 0u) << "an empty state is still a state";
}

TEST(OrganMessages, ATopologyIsUnsettledUntilItLeft) {
  OrganMessages messages(3, kTetrahedra, kMostNodes);
  OrganSnapshot snapshot(ModelSizes{.values = 0, .removed_bytes = 2});
  ASSERT_NE(messages.unsettled_topology(snapshot), nullptr);
  const msg::Topology* const whole = messages.unsettled_topology(snapshot);
  ASSERT_NE(whole, nullptr) << "it did not leave yet";
  EXPECT_EQ(whole->organ, 3u);
  EXPECT_EQ(whole->version, 0u);
  EXPECT_EQ(whole->tetrahedron_count, kTetrahedra);
  EXPECT_THAT(whole->removed_bits, ElementsAre(0, 0));
  messages.settle_topology();
  EXPECT_EQ(messages.unsettled_topology(snapshot), nullptr);
}

TEST(OrganMessages, ATopologyListsWhatWasAddedSinceTheOneThatLeftLast) {
  OrganMessages messages(0, kTetrahedra, kMostNodes);
  OrganSnapshot snapshot(ModelSizes{.values = 0, .removed_bytes = 2});
  const auto cut = [&](std::uint64_t version, std::vector<std::uint8_t> bits) {
    snapshot.take({.topology_version = version, .values = {}, .removed_bits = bits});
    return *messages.unsettled_topology(snapshot);
  };
  EXPECT_THAT(cut(1, {0b100, 0}).last_removed, ElementsAre(2u));
  messages.settle_topology();
  EXPECT_THAT(cut(2, {0b101, 0}).last_removed, ElementsAre(0u));
  EXPECT_THAT(cut(3, {0b101, 0b11}).last_removed, ElementsAre(0u, 8u, 9u)) << "version 2 never left";
}

TEST(LocalModelMessage, IsThePatchAsFarAsItIsUsed) {
  StampedPatch stamped;
  stamped.tool = 1;
  stamped.patch = LocalPatch(5);
  LocalPatch& patch = stamped.patch;
  patch.node_count = 3;
  patch.triangle_count = 1;
  patch.triangles[0] = {0, 1, 2};
  patch.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {9, 9, 9}, {9, 9, 9}};
  for (std::size_t i = 0; i < patch.compliance.size(); ++i) patch.compliance[i] = static_cast<float>(i);
  const std::array<msg::Echo, 2> echoes{msg::Echo{.tool = 0, .seq = 4}, msg::Echo{.tool = 1, .seq = 5}};
  stamped.echoes.take(echoes);

  msg::LocalModel message;
  fill_local_model(stamped, message);
  EXPECT_EQ(message.patch, 1u) << "numbered like the tool that it was made for";
  ASSERT_EQ(message.echoes.size(), 2u);
  EXPECT_EQ(message.echoes[1].seq, 5u);
  EXPECT_EQ(message.nodes.size(), 3u);
  EXPECT_EQ(message.forces.size(), 3u);
  EXPECT_EQ(message.velocities.size(), 3u);
  EXPECT_EQ(message.positions[1], (msg::Vec3{2, 0, 0}));
  EXPECT_EQ(message.triangles, (std::vector<std::uint8_t>{0, 1, 2}));
  ASSERT_EQ(message.compliance.size(), 45u) << "the upper triangle of 9 x 9";
  for (std::size_t i = 0; i < message.compliance.size(); ++i)
    EXPECT_EQ(message.compliance[i], static_cast<float>(i));
}

}  // namespace
}  // namespace omentum::deform
