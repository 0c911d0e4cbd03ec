#include "runtime/signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <future>
#include <thread>

namespace omentum::runtime {
namespace {

// OpenBLAS starts threads before main: they take signals like any other.
TEST(StopSignal, HearsASignalThatAnEarlierThreadTakes) {
  std::promise<void> done;
  std::thread earlier([waiting = done.get_future()] { waiting.wait(); });
  std::promise<void> heard;
  {
    const StopSignal stop([&] { heard.set_value(); });
    pthread_kill(earlier.native_handle(), SIGTERM);
    heard.get_future().wait();
  }
  done.set_value();
  earlier.join();
}

TEST(StopSignal, CallsOnceForManySignals) {
  std::atomic<int> calls = 0;
  std::promise<void> first;
  {
    const StopSignal stop([&] {
      if (++calls == 1) first.set_value();
    });
    for (int i = 0; i < 5; ++i) kill(getpid(), i % 2 ? SIGINT : SIGTERM);
    first.get_future().wait();
  }
  EXPECT_EQ(calls, 1);
}

TEST(StopSignal, GivesTheHandlersBack) {
  struct sigaction before {
  }, after{};
  sigaction(SIGTERM, nullptr, &before);
  {
    const StopSignal stop([] {});
  }
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
}

}  // namespace
}  // namespace omentum::runtime
