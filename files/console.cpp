#include "files/console.h"

#include <algorithm>
#include <array>

#include <limits.h>
#include <poll.h>

namespace omentum::files {

void say(std::string_view line, int fd) noexcept {
  std::array<char, PIPE_BUF> text;  // so much goes as a whole, or not at all
  line = line.substr(0, text.size() - 1);
  *std::ranges::copy(line, text.begin()).out = '\n';
  pollfd room{.fd = fd, .events = POLLOUT, .revents = 0};
  if (poll(&room, 1, 0) != 1 || (room.revents & POLLOUT) == 0) return;
  [[maybe_unused]] const ssize_t written = write(fd, text.data(), line.size() + 1);
}

}  // namespace omentum::files
