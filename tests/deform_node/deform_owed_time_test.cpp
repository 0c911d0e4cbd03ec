#include "deform_node/owed_time.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

TEST(OwedTimeTest, WhatWasMissedIsMadeUpForAFewPeriodsATick) {
  OwedTime owed;
  EXPECT_EQ(owed.take(0, true), 1);
  EXPECT_EQ(owed.take(3, true), 3);
  EXPECT_EQ(owed.take(3, true), 2);
  EXPECT_EQ(owed.take(3, true), 1);
  EXPECT_EQ(owed.take(4, true), 2);
  EXPECT_EQ(owed.take(4, true), 1);
}

TEST(OwedTimeTest, WhoIsAlwaysLateMakesUpForNothingUntilATickIsInTime) {
  OwedTime owed;
  std::uint64_t missed = 0;
  for (int i = 1; i < OwedTime::kMostLate; ++i) EXPECT_EQ(owed.take(++missed, false), 2) << i;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(owed.take(++missed, false), 1) << i;
  EXPECT_EQ(owed.take(missed, true), 3);
}

TEST(OwedTimeTest, ALongStallIsNotMadeUpForAsAWhole) {
  OwedTime owed;
  int made_up = 0;
  for (int i = 0; i < 100; ++i) made_up += owed.take(1000, true) - 1;
  EXPECT_EQ(made_up, OwedTime::kMost);
}

TEST(OwedTimeTest, WhileOrgansStandStillNothingIsOwed) {
  OwedTime owed;
  EXPECT_EQ(owed.take(5, true), 3);
  owed.forgive(9);
  EXPECT_EQ(owed.take(9, true), 1);
}

}  // namespace
}  // namespace omentum::deform
