#include "physics/dynamics/flush_tiny.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::physics {
namespace {

TEST(FlushTinyTest, TinyNumbersAreZeroWhileItLives) {
#ifndef __SSE__
  GTEST_SKIP() << "does nothing on this processor";
#endif
  volatile float smallest = std::numeric_limits<float>::min(), part = 0.25f;
  {
    const FlushTiny flush;
    EXPECT_EQ(smallest * part, 0);
    EXPECT_GT(smallest, 0);
  }
  EXPECT_GT(smallest * part, 0);
}

}  // namespace
}  // namespace omentum::physics
