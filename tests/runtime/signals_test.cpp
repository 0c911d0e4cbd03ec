#include "runtime/signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <thread>

namespace omentum::runtime {
namespace {

// OpenBLAS starts threads before main: they take signals like any other.
TEST(StopSignal, HearsASignalThatAnEarlierThreadTakes) {
  std::atomic<bool> done = false;
  // short sleeps: thread sanitizer hands a signal on when a thread comes back from one
  std::thread earlier([&] {
    while (!done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  std::promise<void> heard;
  {
    const StopSignal stop([&] { heard.set_value(); });
    pthread_kill(earlier.native_handle(), SIGTERM);
    heard.get_future().wait();
  }
  done = true;
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
