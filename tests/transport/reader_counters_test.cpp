#include "transport/reader_counters.h"

#include "tests/support/milliseconds.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace omentum::transport {
namespace {

using test::kMs;
constexpr std::uint32_t kFirst = 0, kSecond = 1;

TEST(DeadlineCounter, CountsWholePeriodsBetweenSamples) {
  DeadlineCounter counter(std::chrono::milliseconds(40));
  counter.arrived(kFirst, 0);
  counter.arrived(kFirst, 39 * kMs);
  EXPECT_EQ(counter.missed(39 * kMs), 0U);
  counter.arrived(kFirst, 129 * kMs);
  EXPECT_EQ(counter.missed(129 * kMs), 2U);
}

TEST(DeadlineCounter, CountsOnWhileNothingComes) {
  DeadlineCounter counter(std::chrono::milliseconds(40));
  EXPECT_EQ(counter.missed(1000 * kMs), 0U) << "nobody has sent yet";
  counter.arrived(kFirst, 1000 * kMs);
  EXPECT_EQ(counter.missed(1040 * kMs), 1U);
  EXPECT_EQ(counter.missed(1080 * kMs), 2U);
  counter.arrived(kFirst, 1085 * kMs);
  EXPECT_EQ(counter.missed(1085 * kMs), 2U) << "a gap is counted once";
}

TEST(DeadlineCounter, OneToolDoesNotSpeakForAnother) {
  DeadlineCounter counter(std::chrono::milliseconds(40));
  counter.arrived(kFirst, 0);
  counter.arrived(kSecond, 0);
  for (std::int64_t now = 10 * kMs; now <= 100 * kMs; now += 10 * kMs) counter.arrived(kFirst, now);
  EXPECT_EQ(counter.missed(100 * kMs), 2U);
}

TEST(DeadlineCounter, ToolsThatNoSceneHasAreNotCounted) {
  DeadlineCounter counter(std::chrono::milliseconds(1));
  counter.arrived(msg::MAX_TOOLS, 0);
  counter.arrived(~0U, 0);
  EXPECT_EQ(counter.missed(1000 * kMs), 0U);
}

TEST(DeadlineCounter, AGapIsNeverCountedTwiceWhileSamplesArrive) {
  // a sample a period: no more periods can be missed than have passed
  DeadlineCounter counter(std::chrono::nanoseconds(1));
  constexpr std::int64_t kSamples = 200'000;
  std::atomic<std::int64_t> now_ns{0};
  std::atomic<int> too_many{0};
  counter.arrived(kFirst, 0);
  std::thread reader([&] {
    while (now_ns < kSamples) {
      const std::uint64_t missed = counter.missed(now_ns);
      too_many += missed > static_cast<std::uint64_t>(now_ns.load());
    }
  });
  for (std::int64_t i = 1; i <= kSamples; ++i) {
    now_ns = i;
    counter.arrived(kFirst, i);
  }
  reader.join();
  EXPECT_EQ(too_many, 0);
  EXPECT_EQ(counter.missed(kSamples), static_cast<std::uint64_t>(kSamples));
}

}  // namespace
}  // namespace omentum::transport
