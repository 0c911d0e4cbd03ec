// Real-time priority and locked memory, where they are permitted.
#pragma once

#include <string>

namespace omentum::runtime {

struct RealtimeGrant {
  bool fifo = false;
  bool locked = false;
  std::string warning;  // empty when everything was granted; else what was refused and what to set
};

/// Asks for SCHED_FIFO for the calling thread, and for locked memory for the process. Never throws.
RealtimeGrant request_realtime(int priority);

/// For a callback that is a link of the hand's loop but runs on a thread of the DDS vendor: asks for
/// SCHED_FIFO for the calling thread the first time it comes by, silently; costs nothing after that.
void follow_realtime(int priority) noexcept;

}  // namespace omentum::runtime
