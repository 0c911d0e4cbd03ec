#include "benchmarks/child_run.h"

#include <gtest/gtest.h>

namespace omentum::bench {
namespace {

constexpr double kMegabyte = 1 << 20;

// dd holds one block
ChildRun hold(int megabytes) {
  return run_child("/usr/bin/env", {"dd", "if=/dev/zero", "of=/dev/null", "count=1", "status=none",
                                    "bs=" + std::to_string(megabytes) + "M"});
}

TEST(ChildRun, MemoryIsThatOfTheOneChild) {
  const ChildRun large = hold(300), small = hold(1);
  ASSERT_EQ(large.exit, 0);
  EXPECT_GT(large.peak_bytes, 300 * kMegabyte);
  EXPECT_LT(small.peak_bytes, 150 * kMegabyte) << "an earlier child counts";
}

TEST(ChildRun, SaysHowItEnded) {
  EXPECT_EQ(run_child("/usr/bin/env", {"sh", "-c", "exit 3"}).exit, 3);
  EXPECT_EQ(run_child("/usr/bin/env", {"sh", "-c", "kill -9 $$"}).exit, -9);
  EXPECT_EQ(run_child("/nonexistent", {}).exit, 127);
}

}  // namespace
}  // namespace omentum::bench
