// Which topology a state belongs to, and what is none of the organ's.
#include "render_node/known_topologies.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr std::uint32_t kCount = 11;  // tetrahedra: the last byte has five bits to spare

msg::Topology topology(std::uint64_t version, std::vector<std::uint8_t> bits) {
  msg::Topology message{};
  message.version = version;
  message.tetrahedron_count = kCount;
  message.removed_bits = std::move(bits);
  return message;
}

TEST(KnownTopologies, BeforeAnyCameVersionZeroIsTheWholeOrgan) {
  const KnownTopologies known(kCount);
  ASSERT_NE(known.removed_in(0), nullptr);
  EXPECT_TRUE(known.removed_in(0)->whole());
  EXPECT_EQ(known.removed_in(1), nullptr);
}

TEST(KnownTopologies, TheLastTwoAreKnown) {
  KnownTopologies known(kCount);
  for (const std::uint64_t version : {1, 2, 3})
    ASSERT_TRUE(known.take(topology(version, {static_cast<std::uint8_t>(version), 0})));
  EXPECT_EQ(known.removed_in(1), nullptr);
  ASSERT_NE(known.removed_in(2), nullptr);
  EXPECT_EQ(known.removed_in(2)->bits[0], 2);
  EXPECT_EQ(known.removed_in(3)->bits[0], 3);
  EXPECT_EQ(known.highest(), 3u);
}

TEST(KnownTopologies, AServerThatCountsFromZeroAgainIsUnderstood) {
  KnownTopologies known(kCount);
  ASSERT_TRUE(known.take(topology(7, {1, 0})));
  ASSERT_TRUE(known.take(topology(0, {0, 0})));
  ASSERT_TRUE(known.take(topology(1, {2, 0})));
  ASSERT_NE(known.removed_in(1), nullptr);
  EXPECT_EQ(known.removed_in(1)->bits[0], 2);
  EXPECT_TRUE(known.removed_in(0)->whole());
}

TEST(KnownTopologies, OneOfAnotherOrganChangesNothing) {
  KnownTopologies known(kCount);
  ASSERT_TRUE(known.take(topology(1, {1, 4})));
  const auto refuses = [&](auto&& spoil) {
    msg::Topology bad = topology(2, {3, 4});
    spoil(bad);
    return !known.take(bad);
  };
  EXPECT_FALSE(refuses([](msg::Topology&) {}));
  EXPECT_TRUE(refuses([](msg::Topology& t) { t.tetrahedron_count = kCount + 1; }));
  EXPECT_TRUE(refuses([](msg::Topology& t) { t.removed_bits[1] = 8; }))
      << "a bit beyond the last tetrahedron";
  EXPECT_TRUE(refuses([](msg::Topology& t) { t.removed_bits = {3, 4, 0}; })) << "more bytes than there are";
  EXPECT_TRUE(refuses([](msg::Topology& t) { t.burnt_bits = {4, 0}; })) << "burnt, and there all the same";
  EXPECT_TRUE(refuses([](msg::Topology& t) { t.burnt_bits = {0, 0, 1}; }));
  EXPECT_EQ(known.highest(), 2u);
  EXPECT_EQ(known.removed_in(2)->bits[1], 4);
}

TEST(KnownTopologies, AnOrganThatIsNeverCutHasWholeOnesOnly) {
  KnownTopologies known(0);
  msg::Topology whole{};
  whole.version = 3;
  EXPECT_TRUE(known.take(whole));
  msg::Topology cut = topology(4, {1});
  cut.tetrahedron_count = 0;
  EXPECT_FALSE(known.take(cut));
}

}  // namespace
}  // namespace omentum::render
