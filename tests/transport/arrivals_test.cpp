#include "transport/arrivals.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace omentum::transport {
namespace {

TEST(Arrivals, OneThreadTakesAtATimeAndNoArrivalIsLost) {
  Arrivals arrivals;
  std::atomic<int> available{0};
  int inside = 0, overlaps = 0, taken = 0;  // unprotected on purpose: Arrivals orders them
  constexpr int kThreads = 4, kEach = 20'000;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < kEach; ++i) {
        ++available;
        arrivals.announce([&] {
          overlaps += inside++ != 0;
          taken += available.exchange(0);
          --inside;
        });
      }
    });
  for (std::thread& thread : threads) thread.join();
  arrivals.close();
  EXPECT_EQ(overlaps, 0);
  EXPECT_EQ(taken, kThreads * kEach);
}

TEST(Arrivals, NothingIsTakenOnceClosed) {
  Arrivals arrivals;
  arrivals.close();
  bool taken = false;
  arrivals.announce([&] { taken = true; });
  EXPECT_FALSE(taken);
}

TEST(Arrivals, CloseWaitsForTheRunningCall) {
  Arrivals arrivals;
  std::atomic<bool> began{false}, go_on{false};
  bool finished = false;
  std::thread taker([&] {
    arrivals.announce([&] {
      began = true;
      began.notify_one();
      go_on.wait(false);
      finished = true;
    });
  });
  began.wait(false);
  std::thread closer([&] {
    arrivals.close();
    EXPECT_TRUE(finished);
  });
  go_on = true;
  go_on.notify_one();
  closer.join();
  taker.join();
}

}  // namespace
}  // namespace omentum::transport
