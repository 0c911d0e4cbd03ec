#include "files/console.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include <fcntl.h>
#include <limits.h>
#include <pty.h>
#include <termios.h>

namespace omentum::files {
namespace {

// What there is to read, without waiting for more.
std::string left_in(int fd) {
  fcntl(fd, F_SETFL, O_NONBLOCK);
  std::string text;
  std::array<char, 4096> part;
  for (ssize_t n = 0; (n = read(fd, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(n));
  return text;
}

struct Ends {
  int ours = -1, theirs = -1;
  ~Ends() {
    close(ours);
    close(theirs);
  }
};

TEST(Console, WaitsForNobodyToEmptyAPipe) {
  Ends ends;
  ASSERT_EQ(pipe(&ends.ours), 0);
  for (int i = 0; i < 100'000; ++i) say("a line", ends.theirs);
  const std::string first = left_in(ends.ours);
  EXPECT_EQ(first.size() % 7, 0u) << "only whole lines";
  say("is heard again", ends.theirs);
  EXPECT_EQ(left_in(ends.ours), "is heard again\n");
}

TEST(Console, WaitsForNoTerminalThatIsStopped) {
  Ends ends;
  ASSERT_EQ(openpty(&ends.ours, &ends.theirs, nullptr, nullptr, nullptr), 0);
  ASSERT_EQ(tcflow(ends.theirs, TCOOFF), 0);
  say("is lost", ends.theirs);
  ASSERT_EQ(tcflow(ends.theirs, TCOON), 0);
  say("is heard", ends.theirs);
  EXPECT_EQ(left_in(ends.ours), "is heard\r\n");
}

TEST(Console, SaysAsMuchAsGoesAtOnce) {
  Ends ends;
  ASSERT_EQ(pipe(&ends.ours), 0);
  say(std::string(2 * PIPE_BUF, 'x'), ends.theirs);
  EXPECT_EQ(left_in(ends.ours), std::string(PIPE_BUF - 1, 'x') + '\n');
}

}  // namespace
}  // namespace omentum::files
