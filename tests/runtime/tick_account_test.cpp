#include "runtime/tick_account.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace omentum::runtime {
namespace {

constexpr std::int64_t kPeriodNs = 1'000'000;

// Ticks of no length that finish at the given times.
LoopRecord account_for(const std::vector<std::int64_t>& finishes) {
  TickAccount account(kPeriodNs);
  for (const auto t : finishes) {
    account.start(t);
    account.finish(t);
  }
  return account.record();
}

TEST(TickAccount, SteadyTicksMissNothing) {
  std::vector<std::int64_t> finishes;
  for (int i = 0; i < 1000; ++i) finishes.push_back(i * kPeriodNs);
  const LoopRecord record = account_for(finishes);
  EXPECT_EQ(record.ticks, 1000u);
  EXPECT_EQ(record.missed, 0u);
  EXPECT_EQ(record.period.count(), 999u);
}

TEST(TickAccount, JitterBelowHalfAPeriodMissesNothing) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<std::int64_t> jitter(0, kPeriodNs / 2 - 1);
  std::vector<std::int64_t> finishes;
  for (int i = 0; i < 10'000; ++i) finishes.push_back(i * kPeriodNs + jitter(random));
  EXPECT_EQ(account_for(finishes).missed, 0u);
}

TEST(TickAccount, EachWholePeriodWithoutATickCountsOnce) {
  for (int gap = 1; gap < 20; ++gap) {
    EXPECT_EQ(account_for({0, kPeriodNs, (1 + gap) * kPeriodNs}).missed, static_cast<unsigned>(gap - 1));
  }
}

TEST(TickAccount, GapsWithinAPeriodMissNothingWhateverTheirOrder) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> gap(1, kPeriodNs);
  std::vector<std::int64_t> finishes{0};
  for (int i = 0; i < 10'000; ++i) finishes.push_back(finishes.back() + gap(random));
  EXPECT_EQ(account_for(finishes).missed, 0u);
}

TEST(TickAccount, ALoopThatIsTooSlowCannotHide) {
  // 1.4 periods each: no single gap is long, but two periods in seven see no tick
  std::vector<std::int64_t> finishes;
  for (int i = 0; i <= 5000; ++i) finishes.push_back(i * kPeriodNs * 14 / 10);
  EXPECT_NEAR(static_cast<double>(account_for(finishes).missed), 2000, 1);
}

TEST(TickAccount, TicksAndMissesTogetherCoverTheElapsedTime) {
  std::mt19937_64 random(4);
  std::exponential_distribution<double> gap(1.0 / 1.3e6);
  std::vector<std::int64_t> finishes{0};
  for (int i = 0; i < 10'000; ++i) {
    finishes.push_back(finishes.back() + static_cast<std::int64_t>(gap(random)));
    const LoopRecord record =
        account_for({finishes.end() - std::min<std::ptrdiff_t>(i + 2, 50), finishes.end()});
    const auto first = *(finishes.end() - std::min<std::ptrdiff_t>(i + 2, 50));
    EXPECT_GE((record.ticks + record.missed + 1) * kPeriodNs,
              static_cast<std::uint64_t>(finishes.back() - first));
  }
}

TEST(TickAccount, ExtraTicksDoNotPayForLaterMisses) {
  EXPECT_EQ(account_for({0, kPeriodNs, kPeriodNs + 1, kPeriodNs + 2, 4 * kPeriodNs}).missed, 1u);
}

TEST(TickAccount, ComputeTimeIsFromStartToFinish) {
  TickAccount account(kPeriodNs);
  account.start(100);
  account.finish(25'100);
  account.start(kPeriodNs + 300);
  account.finish(kPeriodNs + 10'300);
  EXPECT_DOUBLE_EQ(account.record().compute.percentiles().max, 25);
  EXPECT_DOUBLE_EQ(account.record().period.percentiles().max, 1000.2);
  EXPECT_EQ(account.last_compute_ns(), 10'000);
  EXPECT_EQ(account.last_period_ns(), kPeriodNs + 200);
}

}  // namespace
}  // namespace omentum::runtime
