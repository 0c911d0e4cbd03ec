#include "runtime/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace omentum::runtime {
namespace {

// A bin is at most 1/64 of its value wide; what it reports lies within it. Single precision adds its
// rounding.
constexpr double kBin = 1.0 / 64 + 1e-6;

double sorted_percentile_us(std::vector<std::int64_t> values, double fraction) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  return 1e-3 * static_cast<double>(values[std::max<std::size_t>(rank, 1) - 1]);
}

TEST(Histogram, PercentilesAgreeWithSortedValuesWithinABin) {
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> durations(std::log(50'000.0), 2.0);
  Histogram histogram;
  std::vector<std::int64_t> values;
  for (int i = 0; i < 20'000; ++i) {
    values.push_back(static_cast<std::int64_t>(durations(random)));
    histogram.add_ns(values.back());
  }
  for (const double fraction : {0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const double expected = sorted_percentile_us(values, fraction);
    EXPECT_NEAR(histogram.percentile_us(fraction), expected, kBin * expected) << fraction;
  }
}

TEST(Histogram, EveryMagnitudeStaysWithinItsBin) {
  for (std::int64_t ns = 1; ns < 3'600'000'000'000; ns = ns * 9 / 8 + 1) {
    Histogram histogram;
    histogram.add_ns(ns);
    histogram.add_ns(4'000'000'000'000);  // above, so that the exact maximum does not hide the bin
    const double expected = 1e-3 * static_cast<double>(ns);
    EXPECT_NEAR(histogram.percentile_us(0.5), expected, kBin * expected) << ns;
  }
}

TEST(Histogram, ASteadyPeriodReadsAsWhatItIs) {
  Histogram histogram;
  for (int i = 0; i < 60'000; ++i) histogram.add_ns(1'000'000 + (i % 2 ? 300 : -300));
  EXPECT_NEAR(histogram.percentile_us(0.5), 1000, 0.1);
}

TEST(Histogram, MaximumIsExactAndBoundsEveryPercentile) {
  Histogram histogram;
  histogram.add_ns(1'000'003);
  const Percentiles p = histogram.percentiles();
  EXPECT_DOUBLE_EQ(p.max, 1000.003);
  EXPECT_LE(p.p999, p.max);
  EXPECT_EQ(p.count, 1u);
}

TEST(Histogram, EmptyReportsZeroAndNegativeCountsAsZero) {
  Histogram histogram;
  EXPECT_EQ(histogram.percentile_us(0.5), 0);
  histogram.add_ns(-5);
  EXPECT_EQ(histogram.percentiles().max, 0);
  EXPECT_EQ(histogram.count(), 1u);
}

TEST(Histogram, ValuesBeyondTheLastBinAreKept) {
  Histogram histogram;
  histogram.add_ns(INT64_MAX);
  EXPECT_EQ(histogram.count(), 1u);
  EXPECT_GT(histogram.percentile_us(0.5), 3.6e9);  // an hour, us
}

}  // namespace
}  // namespace omentum::runtime
