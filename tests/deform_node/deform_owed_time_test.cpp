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

TEST(OwedTimeTest, ALateTickMakesUpForNothingAndTheNextOneDoes) {
  OwedTime owed;
  EXPECT_EQ(owed.take(1, false), 1);
  EXPECT_EQ(owed.take(1, false), 1);
  EXPECT_EQ(owed.take(1, true), 2);
  EXPECT_EQ(owed.take(1, true), 1);
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
