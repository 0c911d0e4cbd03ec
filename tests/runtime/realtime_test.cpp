#include "runtime/realtime.h"
#include "runtime/memory_limit.h"

#include "runtime/rate_loop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace omentum::runtime {
namespace {

using ::testing::HasSubstr;

constexpr int kPriority = 50;

// What a thread of an ordinary user is granted. Capabilities belong to the thread, limits to the process.
RealtimeGrant request_as_ordinary_user() {
  rlimit priority{}, memory{};
  getrlimit(RLIMIT_RTPRIO, &priority);
  getrlimit(RLIMIT_MEMLOCK, &memory);
  const rlimit no_priority{0, priority.rlim_max}, little_memory{1 << 16, memory.rlim_max};
  setrlimit(RLIMIT_RTPRIO, &no_priority);
  setrlimit(RLIMIT_MEMLOCK, &little_memory);
  RealtimeGrant grant;
  std::thread([&grant] {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    const __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3] = {};
    syscall(SYS_capset, &header, none);
    grant = request_realtime(kPriority);
  }).join();
  setrlimit(RLIMIT_RTPRIO, &priority);
  setrlimit(RLIMIT_MEMLOCK, &memory);
  return grant;
}

TEST(Realtime, WhatIsRefusedIsSaidWithWhatToSet) {
  const RealtimeGrant grant = request_as_ordinary_user();
  EXPECT_FALSE(grant.fifo);
  EXPECT_FALSE(grant.locked);
  EXPECT_THAT(grant.warning, HasSubstr("ulimit -r 50"));
  EXPECT_THAT(grant.warning, HasSubstr("CAP_SYS_NICE"));
  EXPECT_THAT(grant.warning, HasSubstr("ulimit -l unlimited"));
  EXPECT_EQ(grant.warning.find('\n'), std::string::npos);
}

TEST(Realtime, WhatIsGrantedIsNotWarnedOf) {
  std::thread([] {
    const RealtimeGrant grant = request_realtime(kPriority);
    EXPECT_EQ(grant.fifo, grant.warning.find("priority") == std::string::npos);
    EXPECT_EQ(grant.locked, grant.warning.find("memory") == std::string::npos);
    EXPECT_EQ((sched_getscheduler(0) & ~SCHED_RESET_ON_FORK) == SCHED_FIFO, grant.fifo);
  }).join();
  munlockall();
}

TEST(Realtime, WhatWouldFillTheMemoryIsNotLocked) {
  std::thread([] {
    const std::uint64_t most = memory_limit_bytes();
    const RealtimeGrant grant = request_realtime(kPriority, most - most / 4);
    EXPECT_FALSE(grant.locked);
    EXPECT_THAT(grant.warning, HasSubstr("memory is not locked"));
    EXPECT_THAT(grant.warning, HasSubstr("more than half of the " + std::to_string(most >> 20) + " MiB"));
  }).join();
  munlockall();
}

TEST(Realtime, ThreadsStartedLaterDoNotInheritThePriority) {
  std::thread([] {
    request_realtime(kPriority);
    std::thread([] { EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER); }).join();
  }).join();
  munlockall();
}

TEST(Realtime, ThreadsOfAStartKeepThePriorityAndTheStarterDoesNot) {
  std::thread([] {
    std::atomic<bool> ended{false};
    std::thread link;
    {
      const RealtimeStart start(kPriority);
      if (sched_getscheduler(0) != SCHED_FIFO) GTEST_SKIP() << "real-time priority is not permitted here";
      link = std::thread([&] {
        while (!ended) std::this_thread::yield();
        EXPECT_EQ(sched_getscheduler(0), SCHED_FIFO);
      });
    }
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
    ended = true;
    link.join();
  }).join();
}

void stay_on_one_processor() {
  cpu_set_t allowed, one;
  sched_getaffinity(0, sizeof allowed, &allowed);
  int processor = 0;
  while (!CPU_ISSET(processor, &allowed)) ++processor;
  CPU_ZERO(&one);
  CPU_SET(processor, &one);
  sched_setaffinity(0, sizeof one, &one);
}

// Samples wait for the link, which hands them on one by one and wakes the loop each time.
TEST(Realtime, ALoopTicksOnceItsLinkHasHandedOnAllThatWaits) {
  constexpr int kWaiting = 100;
  RateLoop loop(0.1);  // its own schedule plays no part
  std::atomic<bool> ready{false}, permitted{true};
  std::atomic<int> newest{0};
  std::atomic<int> seen_by_first_tick{0};
  std::thread ticks([&] {
    stay_on_one_processor();
    permitted = request_realtime(kHandLoopPriority).fifo;
    ready = true;
    if (permitted && loop.wait() == RateLoop::Cause::kWoken) seen_by_first_tick = newest.load();
  });
  while (!ready) std::this_thread::yield();
  if (permitted) {
    // the loop sleeps by now; were it later, it would only see more
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::thread([&] {
      stay_on_one_processor();
      const RealtimeStart start(kHandLinkPriority);
      for (int sample = 1; sample <= kWaiting; ++sample) {
        newest = sample;
        loop.wake();
      }
    }).join();
  }
  ticks.join();
  munlockall();
  if (!permitted) GTEST_SKIP() << "no permission for real-time priorities";
  EXPECT_EQ(seen_by_first_tick, kWaiting);
}

}  // namespace
}  // namespace omentum::runtime
