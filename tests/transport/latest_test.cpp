#include "transport/latest.h"

#include "tests/support/milliseconds.h"

#include <gtest/gtest.h>

#include <thread>

namespace omentum::transport {
namespace {

using test::kMs;

TEST(SequenceTracker, CountsTheNumbersThatWereSkipped) {
  SequenceTracker tracker;
  EXPECT_TRUE(tracker.accept(10, 0));
  EXPECT_TRUE(tracker.accept(11, kMs));
  EXPECT_TRUE(tracker.accept(15, 2 * kMs));
  EXPECT_EQ(tracker.counters().received, 3U);
  EXPECT_EQ(tracker.counters().lost, 3U);
}

TEST(SequenceTracker, TheFirstNumberIsNoGap) {
  SequenceTracker tracker;
  EXPECT_TRUE(tracker.accept(123'456, 0));
  EXPECT_EQ(tracker.counters().lost, 0U);
}

TEST(SequenceTracker, DropsDuplicatesAndLateSamples) {
  SequenceTracker tracker;
  tracker.accept(5, 0);
  EXPECT_FALSE(tracker.accept(5, kMs));
  EXPECT_FALSE(tracker.accept(4, 2 * kMs));
  EXPECT_TRUE(tracker.accept(6, 3 * kMs));
  EXPECT_EQ(tracker.counters().duplicates, 1U);
  EXPECT_EQ(tracker.counters().out_of_order, 1U);
  EXPECT_EQ(tracker.counters().lost, 0U);
}

TEST(SequenceTracker, AnotherSendersFirstIsNewWhateverItsNumber) {
  SequenceTracker tracker;
  EXPECT_TRUE(tracker.accept(1000, 0));
  EXPECT_TRUE(tracker.accept(5, 1, true));
  EXPECT_FALSE(tracker.accept(4, 2));
  EXPECT_TRUE(tracker.accept(9000, 3, true));
  EXPECT_EQ(tracker.counters().lost, 0u);
  EXPECT_EQ(tracker.counters().restarts, 2u);
}

TEST(SequenceTracker, ASmallerNumberAfterASilenceIsARestartedSender) {
  SequenceTracker tracker;
  tracker.accept(1000, 0);
  EXPECT_FALSE(tracker.accept(1, SequenceTracker::kRestartSilence_ns));
  EXPECT_TRUE(tracker.accept(2, SequenceTracker::kRestartSilence_ns + 1));
  EXPECT_TRUE(tracker.accept(3, SequenceTracker::kRestartSilence_ns + kMs));
  EXPECT_EQ(tracker.counters().restarts, 1U);
  EXPECT_EQ(tracker.counters().lost, 0U);
}

TEST(SequenceTracker, TheSameNumberAfterASilenceIsStillADuplicate) {
  SequenceTracker tracker;
  tracker.accept(7, 0);
  EXPECT_FALSE(tracker.accept(7, 10 * SequenceTracker::kRestartSilence_ns));
  EXPECT_EQ(tracker.counters().duplicates, 1U);
}

TEST(NewestCell, IsEmptyAtFirst) {
  const NewestCell<msg::ToolPose> cell;
  msg::ToolPose pose;
  pose.seq = 99;
  EXPECT_FALSE(cell.load(pose));
  EXPECT_EQ(pose.seq, 99U);
}

TEST(NewestCell, GivesBackWhatWasStoredLast) {
  NewestCell<msg::ToolForce> cell;
  for (std::uint64_t seq = 1; seq <= 5; ++seq) {
    msg::ToolForce stored;
    stored.seq = seq;
    stored.force = {1.0 * static_cast<double>(seq), -2.0, 3.0};
    cell.store(stored);
    msg::ToolForce loaded;
    ASSERT_TRUE(cell.load(loaded));
    EXPECT_EQ(loaded, stored);
  }
}

// all words of a value are equal, so that a mixture of two values shows
struct Uniform {
  std::array<std::uint64_t, 24> words;
};

TEST(NewestCell, ReadersNeverSeeHalfAValueNorAnOlderOne) {
  NewestCell<Uniform> cell;
  std::atomic<bool> ended{false};
  std::atomic<int> mixed{0}, backwards{0};
  const auto read = [&] {
    std::uint64_t newest = 0;
    while (!ended) {
      Uniform value;
      if (!cell.load(value)) continue;
      for (const std::uint64_t word : value.words) mixed += word != value.words[0];
      backwards += value.words[0] < newest;
      newest = value.words[0];
    }
  };
  std::thread first(read), second(read);
  constexpr std::uint64_t kStores = 200'000;
  for (std::uint64_t i = 1; i <= kStores; ++i) {
    Uniform value;
    value.words.fill(i);
    cell.store(value);
  }
  ended = true;
  first.join();
  second.join();
  EXPECT_EQ(mixed, 0);
  EXPECT_EQ(backwards, 0);
}

}  // namespace
}  // namespace omentum::transport
