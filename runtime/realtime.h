// Real-time priority and locked memory, where they are permitted.
#pragma once

#include <cstdint>
#include <string>

#include <sched.h>

namespace omentum::runtime {

/// SCHED_FIFO priorities of the hand's loop, in haptic_node and in a device's program alike: above everything
/// that is not the kernel's own. Equal on both sides, so that neither cuts the other short in the middle of a
/// write.
inline constexpr int kHandLoopPriority = 60;
/// The DDS vendor's threads that carry its samples: above all ordinary work, which would hold a lock that the
/// loop needs while a picture is drawn, and equal to the loop itself. Above it they would cut a tick short at
/// every sample; below it the loop would cut them short at every pose that wakes it, and compute with each of
/// those that wait in the socket while newer ones come behind: so they take all that has come, then it ticks.
inline constexpr int kHandLinkPriority = kHandLoopPriority;

struct RealtimeGrant {
  bool fifo = false;
  bool locked = false;
  std::string warning;  // empty when everything was granted; else what was refused and what to set
};

/// Asks for SCHED_FIFO for the calling thread, and for locked memory for the process, which will touch
/// `touched_bytes` of mapped files: everything that it touches stays in memory then. Not asked for where that
/// would be more than half of what the machine or its container allows (memory_limit.h). Never throws.
RealtimeGrant request_realtime(int priority, std::uint64_t touched_bytes = 0);

/// While it lives, the calling thread runs under SCHED_FIFO, and so do the threads that it starts, for good:
/// wrapped around the start of a library whose threads are links of a real-time loop. Where that is not
/// permitted it does nothing, silently: request_realtime says so. Ends on the thread it began on.
class RealtimeStart {
 public:
  explicit RealtimeStart(int priority) noexcept;
  ~RealtimeStart();
  RealtimeStart(const RealtimeStart&) = delete;
  RealtimeStart& operator=(const RealtimeStart&) = delete;

 private:
  int policy_ = 0;
  sched_param parameters_{};
};

}  // namespace omentum::runtime
