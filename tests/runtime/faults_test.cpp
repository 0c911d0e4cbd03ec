#include "runtime/faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace omentum::runtime {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(FaultList, RepeatedFaultsAreOneEntryWithACount) {
  FaultList faults;
  EXPECT_FALSE(faults.any());
  for (int i = 0; i < 5; ++i) faults.raise("tool 0: position is not finite");
  faults.raise("tool 1: stale");
  ASSERT_EQ(faults.list().size(), 2u);
  EXPECT_TRUE(faults.any());
  EXPECT_EQ(faults.list()[0].count, 5u);
  EXPECT_THAT(faults.lines()[0], StartsWith("tool 0: position is not finite (first at "));
  EXPECT_THAT(faults.lines()[0], HasSubstr("5 times"));
}

TEST(FaultList, WhatDoesNotFitIsCounted) {
  FaultList faults;
  for (int i = 0; i < FaultList::kCapacity + 3; ++i) faults.raise("fault " + std::to_string(i));
  EXPECT_EQ(faults.list().size(), static_cast<std::size_t>(FaultList::kCapacity));
  EXPECT_EQ(faults.lines().back(), "3 further faults");
}

TEST(FaultList, LongTextsAreCutToWhatTheMessageHolds) {
  FaultList faults;
  faults.raise(std::string(500, 'x'));
  EXPECT_EQ(faults.list()[0].text.size(), static_cast<std::size_t>(FaultList::kTextSize));
  EXPECT_LE(faults.lines()[0].size(), 160u);  // NodeStatus.faults in idl/session.idl
}

TEST(FaultList, ThreadsLoseNoFault) {
  constexpr int kThreads = 4, kRaises = 5000;
  FaultList faults;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&faults] {
      for (int i = 0; i < kRaises; ++i) {
        faults.raise(i % 2 ? "odd" : "even");
        if (i % 100 == 0) (void)faults.lines();
      }
    });
  }
  for (auto& thread : threads) thread.join();
  ASSERT_EQ(faults.list().size(), 2u);
  EXPECT_EQ(faults.list()[0].count + faults.list()[1].count, static_cast<unsigned>(kThreads * kRaises));
}

}  // namespace
}  // namespace omentum::runtime
