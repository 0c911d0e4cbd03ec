#include "benchmarks/ping_account.h"

#include <gtest/gtest.h>

namespace omentum::bench {
namespace {

TEST(PingAccount, NumbersCountFromOneAndEachRoundTripIsItsOwn) {
  PingAccount account;
  EXPECT_EQ(account.send(1'000'000), 1);
  EXPECT_EQ(account.send(2'000'000), 2);
  EXPECT_TRUE(account.receive(2, 2'050'000));  // overtaken by the second
  EXPECT_TRUE(account.receive(1, 2'100'000));
  const runtime::Percentiles times = account.round_trip();
  EXPECT_EQ(times.count, 2);
  EXPECT_NEAR(times.p50, 50, 1);
  EXPECT_EQ(times.max, 1100);
  EXPECT_EQ(account.lost(), 0);
}

TEST(PingAccount, WhatIsNotBackIsLost) {
  PingAccount account;
  for (int i = 0; i < 10; ++i) account.send(1'000 * i);
  for (const std::uint64_t seq : {1, 2, 3, 5, 8}) account.receive(seq, 20'000);
  EXPECT_EQ(account.sent(), 10);
  EXPECT_EQ(account.lost(), 5);
}

TEST(PingAccount, ACopyAndANumberThatNobodySentDoNotCount) {
  PingAccount account;
  account.send(0);
  account.send(0);
  EXPECT_TRUE(account.receive(1, 10'000));
  EXPECT_FALSE(account.receive(1, 90'000));
  EXPECT_FALSE(account.receive(0, 10'000));
  EXPECT_FALSE(account.receive(3, 10'000));
  EXPECT_EQ(account.round_trip().count, 1);
  EXPECT_EQ(account.lost(), 1);
}

TEST(PingAccount, ANumberWhosePlaceIsTakenByANewerOneIsLost) {
  PingAccount account;
  for (std::size_t i = 0; i < PingAccount::kRemembered + 1; ++i) account.send(0);
  EXPECT_FALSE(account.receive(1, 10'000));
  EXPECT_TRUE(account.receive(2, 10'000));
  EXPECT_EQ(account.lost(), PingAccount::kRemembered);
}

}  // namespace
}  // namespace omentum::bench
