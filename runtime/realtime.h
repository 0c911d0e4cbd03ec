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

}  // namespace omentum::runtime
