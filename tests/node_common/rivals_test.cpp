#include "node_common/rivals.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::node {
namespace {

constexpr std::uint64_t kOwn = 1000;
constexpr std::int64_t kPeriod_ns = 100'000'000;  // of a serving node's statuses
constexpr int kEnough = 4;                        // of them prove a claim

msg::NodeStatus status_of(std::uint64_t instance, std::uint64_t ticks) {
  msg::NodeStatus status{};
  status.kind = msg::NODE_HAPTIC;
  status.instance = instance;
  status.rate_hz = 1000;
  status.ticks = ticks;
  return status;
}

class RivalsTest : public testing::Test {
 protected:
  bool hear(const msg::NodeStatus& status) { return rivals_.proven(status, now_ns_); }
  /// A living node's statuses; whether the last one counts.
  bool hear_living(std::uint64_t instance, int statuses) {
    bool counts = false;
    for (int i = 0; i < statuses; ++i) {
      counts = hear(status_of(instance, ticks_ += 100));
      now_ns_ += kPeriod_ns;
    }
    return counts;
  }
  Rivals rivals_{msg::NODE_HAPTIC, kOwn};
  std::int64_t now_ns_ = 1'000'000'000;
  std::uint64_t ticks_ = 0;
};

TEST_F(RivalsTest, ALivingNodesClaimCounts) {
  EXPECT_TRUE(hear_living(1, kEnough));
}

TEST_F(RivalsTest, OneSampleProvesNothingWhateverItSays) {
  EXPECT_FALSE(hear(status_of(1, std::numeric_limits<std::uint64_t>::max())));
  now_ns_ += kPeriod_ns;
  EXPECT_FALSE(hear(status_of(0, 1))) << "nor another one, of another instance";
}

TEST_F(RivalsTest, ABurstAndARepeatedSampleProveNothing) {
  for (std::uint64_t i = 1; i < 100; ++i) EXPECT_FALSE(hear(status_of(1, i))) << "all at one moment";
  for (int i = 0; i < 20; ++i) {
    now_ns_ += kPeriod_ns;
    EXPECT_FALSE(hear(status_of(2, 7))) << "its loop stands still";
  }
}

TEST_F(RivalsTest, WhoFellSilentProvesItselfAnew) {
  ASSERT_TRUE(hear_living(1, kEnough));
  now_ns_ += 2 * Rivals::kSilence_ns;
  EXPECT_FALSE(hear_living(1, 1));
  EXPECT_TRUE(hear_living(1, kEnough));
}

TEST_F(RivalsTest, ManyNamesDoNotHideALivingOne) {
  std::uint64_t stranger = 5'000;
  bool counts = false;
  for (int i = 0; i < kEnough; ++i) {
    counts = hear_living(1, 1);
    for (int k = 0; k < 5; ++k) EXPECT_FALSE(hear(status_of(++stranger, 9)));
  }
  EXPECT_TRUE(counts) << "the strangers, heard once each, made room for each other";
}

TEST_F(RivalsTest, ItsOwnStatusAndOtherKindsAreNoRivals) {
  EXPECT_FALSE(hear_living(kOwn, kEnough));
  for (int i = 0; i < kEnough; ++i, now_ns_ += kPeriod_ns) {
    msg::NodeStatus device = status_of(1, ticks_ += 100);
    device.kind = msg::NODE_DEVICE;
    EXPECT_FALSE(hear(device));
  }
}

TEST(StandingOf, NeedsARate) {
  constexpr std::uint64_t kMany = 1'000'000;
  EXPECT_EQ(standing_of(kMany, 1000), Standing::kSettled);
  EXPECT_EQ(standing_of(100, 1000), Standing::kYoung);
  for (const double rate_hz :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(standing_of(kMany, rate_hz), Standing::kYoung) << rate_hz;
}

// Every pair of standings and instances.
TEST(GoesBefore, OneOfTwoDoes) {
  constexpr std::array kStandings = {Standing::kListening, Standing::kYoung, Standing::kSettled};
  for (const Standing one : kStandings) {
    for (const Standing other : kStandings) {
      for (const std::uint64_t instance : {1, 2000}) {
        const Claim mine{kOwn, one}, theirs{instance, other};
        EXPECT_NE(goes_before(mine, theirs), goes_before(theirs, mine));
        if (one > other) {
          EXPECT_TRUE(goes_before(mine, theirs)) << "whatever the clocks say";
        }
      }
    }
  }
}

}  // namespace
}  // namespace omentum::node
