#include "deform_node/owed_time.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

TEST(OwedTimeTest, WhatWasMissedIsMadeUpForOnePeriodATick) {
  OwedTime owed;
  EXPECT_EQ(owed.take(0), 1);
  EXPECT_EQ(owed.take(2), 2);
  EXPECT_EQ(owed.take(2), 2);
  EXPECT_EQ(owed.take(2), 1);
  EXPECT_EQ(owed.take(3), 2);
  EXPECT_EQ(owed.take(3), 1);
}

TEST(OwedTimeTest, ALongStallIsNotMadeUpForAsAWhole) {
  OwedTime owed;
  std::uint64_t made_up = 0;
  for (int i = 0; i < 100; ++i) made_up += static_cast<std::uint64_t>(owed.take(1000) - 1);
  EXPECT_EQ(made_up, OwedTime::kMost);
}

TEST(OwedTimeTest, WhileOrgansStandStillNothingIsOwed) {
  OwedTime owed;
  EXPECT_EQ(owed.take(5), 2);
  owed.forgive(9);
  EXPECT_EQ(owed.take(9), 1);
}

}  // namespace
}  // namespace omentum::deform
