// A line for whoever watches a program, which waits for nobody.
#pragma once

#include <string_view>

#include <unistd.h>

namespace omentum::files {

/// Writes the line, and its end, to `fd` at once, of a longer one the first PIPE_BUF bytes. Where it would
/// have to wait, it is lost: for a pipe that nobody empties, or a terminal that somebody stopped (Ctrl-S). So
/// no thread that a hand depends on stands still there.
void say(std::string_view line, int fd = STDERR_FILENO) noexcept;

}  // namespace omentum::files
