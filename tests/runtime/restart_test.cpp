#include "tests/support/process.h"

#include <gtest/gtest.h>

namespace omentum::runtime {
namespace {

TEST(Restart, HappensOnceWithTheSameArguments) {
  test::Process process("restart_example", {"a", "b c"});
  EXPECT_EQ(process.wait(), 0);
  EXPECT_EQ(process.output(), "begins\nbegins\n3 words, the last one b c: anew\n");
}

TEST(Restart, APersonsOwnValueStands) {
  test::Process process("/usr/bin/env",
                        {"OMENTUM_RESTART_TEST=own", OMENTUM_BIN_DIR "/restart_example", "a"});
  EXPECT_EQ(process.wait(), 0);
  EXPECT_EQ(process.output(), "begins\n2 words, the last one a: own\n");
}

}  // namespace
}  // namespace omentum::runtime
