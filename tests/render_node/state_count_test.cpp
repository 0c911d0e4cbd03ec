#include "render_node/state_count.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace omentum::render {
namespace {

TEST(StateCount, WhatIsSkippedBetweenTwoStatesIsMissing) {
  StateCount count;
  for (const std::uint64_t seq : {41, 42, 45, 46, 50}) count.shown(seq, 0);
  EXPECT_EQ(count.counts().whole, 5);
  EXPECT_EQ(count.counts().missing, 2 + 3);
  EXPECT_EQ(count.counts().incomplete, 0);
}

TEST(StateCount, AStateThatLacksBlocksIsIncompleteAndNotMissing) {
  StateCount count;
  count.shown(1, 0);
  count.shown(2, 3);
  count.shown(3, 0);
  EXPECT_EQ(to_json(count.counts()), (nlohmann::json{{"whole", 2}, {"incomplete", 1}, {"missing", 0}}));
}

TEST(StateCount, NothingIsMissingWhereDeformNodeCountsAnew) {
  StateCount count;
  count.shown(900, 0);
  count.shown(3, 0);
  count.shown(5, 0);
  EXPECT_EQ(count.counts().missing, 1);
}

TEST(StateCount, OrgansAddUp) {
  StateCounts sum{.whole = 5, .incomplete = 1, .missing = 2};
  sum += {.whole = 10, .incomplete = 20, .missing = 30};
  EXPECT_EQ(to_json(sum), (nlohmann::json{{"whole", 15}, {"incomplete", 21}, {"missing", 32}}));
}

}  // namespace
}  // namespace omentum::render
