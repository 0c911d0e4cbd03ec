#include "runtime/signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <future>
#include <thread>

namespace omentum::runtime {
namespace {

constexpr unsigned kHangs_s = 20;  // a child that should have ended long ago

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

// A launcher may ask more than once, and the last time when main has returned: statics are still being
// destroyed.
TEST(StopSignal, ASignalAfterItsEndDoesNotEndTheProgramEarlier) {
  EXPECT_EXIT(
      {
        std::atexit([] { kill(getpid(), SIGTERM); });
        {
          const StopSignal stop([] {});
        }
        kill(getpid(), SIGINT);
        std::exit(0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(StopSignal, ASignalWhileTheProgramEndsChangesNothing) {
  EXPECT_EXIT(
      {
        {
          std::promise<void> heard;
          const StopSignal stop([&] { heard.set_value(); });
          kill(getpid(), SIGTERM);
          heard.get_future().wait();
          kill(getpid(), SIGTERM);
        }
        std::exit(0);
      },
      testing::ExitedWithCode(0), "");
}

// A person whose program hangs while it ends presses Ctrl-C again.
TEST(StopSignal, PatienceWithAProgramThatHangsHasAnEnd) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          std::promise<void> heard;
          const StopSignal stop([&] { heard.set_value(); }, std::chrono::seconds(0));
          kill(getpid(), signal);
          heard.get_future().wait();
          kill(getpid(), signal);
          for (alarm(kHangs_s);;) pause();
        },
        testing::KilledBySignal(signal), "");
  }
}

TEST(StopSignal, HearsWhatWasHeldBackUntilItLived) {
  std::promise<void> heard;
  std::thread([&] {
    sigset_t stop_signals;
    sigemptyset(&stop_signals);
    sigaddset(&stop_signals, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &stop_signals, nullptr);
    pthread_kill(pthread_self(), SIGTERM);
    const StopSignal stop([&] { heard.set_value(); });
    heard.get_future().wait();
  }).join();
}

TEST(StopSignal, ANewOneHearsAgain) {
  for (int i = 0; i < 2; ++i) {
    std::promise<void> heard;
    const StopSignal stop([&] { heard.set_value(); });
    kill(getpid(), SIGTERM);
    heard.get_future().wait();
  }
}

// A pager that is closed takes no force from a hand.
TEST(StopSignal, APipeThatNobodyReadsDoesNotEndTheProgram) {
  EXPECT_EXIT(
      {
        const StopSignal stop([] {});
        int ends[2];
        if (pipe(ends) != 0) std::exit(1);
        close(ends[0]);
        std::exit(write(ends[1], "told", 4) < 0 ? 0 : 2);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace omentum::runtime
