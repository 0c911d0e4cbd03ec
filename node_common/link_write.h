// What an ordinary thread writes in a process whose DDS threads are real-time.
#pragma once

#include "runtime/realtime.h"
#include "transport/bus.h"

namespace omentum::node {

/// Writes at the priority of the link's own threads (runtime::kHandLinkPriority), as far as that is
/// permitted: the ceiling of everybody who takes the writer's lock. Fast DDS' sending thread, real-time in
/// haptic_node and in a device, tries that lock again and again while somebody else holds it. Whoever it cut
/// short in the middle of a write would get no processor to end it with, and nobody else of ordinary
/// priority: not for 0.95 s, when the kernel sets real-time threads aside (seen with samples of more than one
/// datagram on the profile lan). Returns write()'s.
template <class Message>
bool write_as_link(transport::Writer<Message>& writer, const Message& sample) noexcept {
  const runtime::RealtimeStart turn(runtime::kHandLinkPriority);
  return writer.write(sample);
}

}  // namespace omentum::node
