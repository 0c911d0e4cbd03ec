#include "runtime/tick_account.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace omentum::runtime {
namespace {

constexpr std::int64_t kTick_ns = 1'000'000;

// Ticks of no length that finish at the given times.
LoopRecord account_for(const std::vector<std::int64_t>& finishes) {
  TickAccount account(kTick_ns);
  for (const auto t : finishes) {
    account.start(t);
    account.finish(t);
  }
  return account.record();
}

TEST(TickAccount, SteadyTicksMissNothing) {
  std::vector<std::int64_t> finishes;
  for (int i = 0; i < 1000; ++i) finishes.push_back(i * kTick_ns);
  const LoopRecord record = account_for(finishes);
  EXPECT_EQ(record.ticks, 1000u);
  EXPECT_EQ(record.missed, 0u);
  EXPECT_EQ(record.period.count(), 999u);
}

TEST(TickAccount, JitterBelowHalfAPeriodMissesNothing) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<std::int64_t> jitter(0, kTick_ns / 2 - 1);
  std::vector<std::int64_t> finishes;
  for (int i = 0; i < 10'000; ++i) finishes.push_back(i * kTick_ns + jitter(random));
  EXPECT_EQ(account_for(finishes).missed, 0u);
}

TEST(TickAccount, EachWholePeriodWithoutATickCountsOnce) {
  for (int gap = 1; gap < 20; ++gap) {
    EXPECT_EQ(account_for({0, kTick_ns, (1 + gap) * kTick_ns}).missed, static_cast<unsigned>(gap - 1));
  }
}

TEST(TickAccount, GapsWithinAPeriodMissNothingWhateverTheirOrder) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> gap(1, kTick_ns);
  std::vector<std::int64_t> finishes{0};
  for (int i = 0; i < 10'000; ++i) finishes.push_back(finishes.back() + gap(random));
  EXPECT_EQ(account_for(finishes).missed, 0u);
}

TEST(TickAccount, ALoopThatIsTooSlowCannotHide) {
  // 1.4 periods each: no single gap is long, but two periods in seven see no tick
  std::vector<std::int64_t> finishes;
  for (int i = 0; i <= 5000; ++i) finishes.push_back(i * kTick_ns * 14 / 10);
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
    EXPECT_GE((record.ticks + record.missed + 1) * kTick_ns,
              static_cast<std::uint64_t>(finishes.back() - first));
  }
}

TEST(TickAccount, ExtraTicksDoNotPayForLaterMisses) {
  EXPECT_EQ(account_for({0, kTick_ns, kTick_ns + 1, kTick_ns + 2, 4 * kTick_ns}).missed, 1u);
}

TEST(TickAccount, ComputeTimeIsFromStartToFinish) {
  TickAccount account(kTick_ns);
  account.start(100);
  account.finish(25'100);
  account.start(kTick_ns + 300);
  account.finish(kTick_ns + 10'300);
  EXPECT_DOUBLE_EQ(account.record().compute.percentiles().max, 25);
  EXPECT_DOUBLE_EQ(account.record().period.percentiles().max, 1000.2);
  EXPECT_EQ(account.last_compute_ns(), 10'000);
  EXPECT_EQ(account.last_period_ns(), kTick_ns + 200);
}

}  // namespace
}  // namespace omentum::runtime
