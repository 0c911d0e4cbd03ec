// What needs no clock is tested on TickAccount and WakeGate; here is the waiting itself. No duration is
// asserted.
#include "runtime/rate_loop.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <thread>

namespace omentum::runtime {
namespace {

constexpr double kSlow_hz = 0.1;  // a scheduled tick would take 10 s: a test that waits for one is seen

TEST(RateLoop, RefusesRatesThatAreNone) {
  for (const double rate : {0.0, -1.0, 1e6, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(RateLoop{rate}, std::invalid_argument) << rate;
  }
}

TEST(RateLoop, AWakeEndsTheWait) {
  RateLoop loop(kSlow_hz);
  std::thread waker([&] { loop.wake(); });
  EXPECT_EQ(loop.wait(), RateLoop::Cause::kWoken);
  waker.join();
}

TEST(RateLoop, AWakeBeforeTheWaitIsNotLost) {
  RateLoop loop(kSlow_hz);
  loop.wake();
  EXPECT_EQ(loop.wait(), RateLoop::Cause::kWoken);
}

TEST(RateLoop, StopEndsTheWaitForGood) {
  RateLoop loop(kSlow_hz);
  std::thread stopper([&] { loop.stop(); });
  EXPECT_EQ(loop.wait(), RateLoop::Cause::kStopped);
  stopper.join();
  EXPECT_EQ(loop.wait(), RateLoop::Cause::kStopped);
}

TEST(RateLoop, TicksOnItsOwnAndRecordsThem) {
  RateLoop loop(1000);
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(loop.wait(), RateLoop::Cause::kSchedule);
    loop.finish_tick();
  }
  EXPECT_EQ(loop.record().ticks, 20u);
  EXPECT_EQ(loop.record().compute.count(), 20u);
  EXPECT_EQ(loop.record().period.count(), 19u);
}

TEST(RateLoop, WorkBesideItGoesOnUntilItIsGivenBack) {
  RateLoop loop(kSlow_hz);
  std::atomic<int> calls{0};
  auto work = loop.beside(std::chrono::milliseconds(1), [&] {
    ++calls;
    calls.notify_one();
  });
  for (int seen = calls; seen < 3; seen = calls) calls.wait(seen);
  work.reset();
  EXPECT_GE(calls, 3);
}

TEST(RateLoop, EveryPostOfAnotherThreadIsSeenByATickThatStartsLater) {
  // no lost wake-up: the waker waits for each tick before it wakes again
  RateLoop loop(kSlow_hz);
  std::atomic<int> posted{0}, seen{0};
  std::thread waker([&] {
    for (int i = 1; i <= 2000; ++i) {
      posted = i;
      loop.wake();
      while (seen != i) std::this_thread::yield();
    }
    loop.stop();
  });
  while (loop.wait() != RateLoop::Cause::kStopped) {
    seen = posted.load();
    loop.finish_tick();
  }
  waker.join();
  EXPECT_EQ(seen, 2000);
}

}  // namespace
}  // namespace omentum::runtime
