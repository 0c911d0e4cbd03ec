#include "transport/standstill.h"

#include "tests/support/milliseconds.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <atomic>

namespace omentum::transport {
namespace {

using test::kMs;
constexpr std::chrono::milliseconds kLongest{500};

TEST(Standstill, IsAGapBetweenTwoLooksThatIsLongerThanTheLongest) {
  Standstill standstill(kLongest);
  EXPECT_FALSE(standstill.found(1'000'000 * kMs));  // the first look has none before it
  EXPECT_FALSE(standstill.found(1'000'250 * kMs));
  EXPECT_FALSE(standstill.found(1'000'750 * kMs));
  EXPECT_TRUE(standstill.found(1'001'251 * kMs));
  EXPECT_FALSE(standstill.found(1'001'500 * kMs));  // found once
}

TEST(StandstillWatch, AsksAgainUntilItSucceeds) {
  std::atomic<int> asked{0};
  // every two looks are farther apart than this
  StandstillWatch watch(std::chrono::nanoseconds(1), [&] { return ++asked >= 3; });
  EXPECT_TRUE(test::comes_true([&] { return asked >= 3; }));
}

TEST(StandstillWatch, OfAProcessThatRunsNeverActs) {
  std::atomic<int> asked{0};
  {
    StandstillWatch watch(std::chrono::hours(1), [&] { return ++asked > 0; });
  }
  EXPECT_EQ(asked, 0);
}

}  // namespace
}  // namespace omentum::transport
