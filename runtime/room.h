// Room for what a program starts: libraries that meet a limit in the middle of it end in a signal.
#pragma once

#include <cstddef>

namespace omentum::runtime {

/// What a program takes beside its own pages.
struct Room {
  int threads = 0;        // at a time, with their stacks
  std::size_t bytes = 0;  // of addresses, beside the stacks
};

/// Of a participant of either vendor with our own threads: 13 were seen, and 480 MB with the heaps that glibc
/// gives each thread.
inline constexpr Room kRoomForDds{16, std::size_t{512} << 20};

/// Whether the system gives so much (ulimit -v, -u; control groups bound processes, too): takes it all at a
/// time, touches none of it, and gives it back. Any thread; a millisecond.
[[nodiscard]] bool has_room(const Room& room) noexcept;

}  // namespace omentum::runtime
