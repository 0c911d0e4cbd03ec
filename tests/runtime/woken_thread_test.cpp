#include "runtime/woken_thread.h"

#include "runtime/mailbox.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <latch>
#include <memory>

namespace omentum::runtime {
namespace {

TEST(WokenThread, WorksAfterAWake) {
  std::latch worked(1);
  bool first = true;
  WokenThread thread([&] {
    if (std::exchange(first, false)) worked.count_down();
  });
  thread.wake();
  worked.wait();
}

TEST(WokenThread, WhatWasHandedOverBeforeTheEndIsWorkedOff) {
  for (int trial = 0; trial < 200; ++trial) {
    Mailbox<int> box;
    int seen = 0;
    {
      WokenThread thread([&] {
        if (box.fetch()) seen = box.value();
      });
      for (const int value : {1, 2, 3}) {
        box.post(value);
        thread.wake();
      }
    }
    EXPECT_EQ(seen, 3);
  }
}

TEST(WokenThread, AWakeDuringTheWorkIsNotLost) {
  std::latch working(1), woken(1), again(2);
  int calls = 0;
  WokenThread thread([&] {
    if (++calls == 1) {
      working.count_down();
      woken.wait();
    }
    if (calls <= 2) again.count_down();
  });
  thread.wake();
  working.wait();
  thread.wake();
  woken.count_down();
  again.wait();
}

TEST(WokenThread, WakingTakesNoMemory) {
  WokenThread thread([] {});
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 100; ++i) thread.wake();
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::runtime
