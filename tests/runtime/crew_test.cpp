#include "runtime/crew.h"

#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <latch>
#include <numeric>
#include <set>

namespace omentum::runtime {
namespace {

TEST(Crew, DoesEachPartOnceWhateverItsSize) {
  for (const std::size_t helpers : {0, 1, 3}) {
    Crew crew(helpers);
    EXPECT_EQ(crew.helpers(), helpers);
    for (const std::size_t count : {0, 1, 2, 5, 64}) {
      std::vector<int> done(count);
      crew.share(count, [&](std::size_t i) { ++done[i]; });
      EXPECT_EQ(done, std::vector<int>(count, 1));
    }
  }
}

TEST(Crew, ACallReturnsWhenAllIsDone) {
  Crew crew(2);
  std::vector<std::uint64_t> sums(4);
  for (std::uint64_t call = 1; call <= 2000; ++call) {
    crew.share(sums.size(), [&](std::size_t i) { sums[i] += call; });
    EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}), 4 * (call * (call + 1) / 2));
  }
}

// Two parts that wait for each other need two threads.
TEST(Crew, PartsAreDoneAtTheSameTime) {
  Crew crew(1);
  std::latch both(2);
  std::vector<std::thread::id> who(2);
  crew.share(2, [&](std::size_t i) {
    who[i] = std::this_thread::get_id();
    both.arrive_and_wait();
  });
  EXPECT_NE(who[0], who[1]);
}

TEST(Crew, AloneItTakesPartsInTheirOrder) {
  Crew crew(0);
  std::vector<std::size_t> order;
  crew.share(3, [&](std::size_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Crew, SharingTakesNoMemory) {
  Crew crew(1);
  std::vector<int> done(8);
  const auto part = [&](std::size_t i) { ++done[i]; };
  crew.share(done.size(), part);
  const std::size_t before = test::heap_allocations();
  for (int call = 0; call < 100; ++call) crew.share(done.size(), part);
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::runtime
