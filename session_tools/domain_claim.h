// Who may use a DDS domain of the network.
#pragma once

#include "transport/messages.h"

#include <optional>
#include <string>

namespace omentum::session {

/// A launcher's claim to a domain, told as a NodeStatus of kind NODE_LAUNCHER: no ticks while it listens,
/// some once it holds the domain.
struct DomainClaim {
  std::uint64_t instance = 0;  // start time, ns, wall clock
  std::string host;
  bool held = false;
};

msg::NodeStatus status_of(const DomainClaim& claim);

/// Who goes before the own claim, e.g. "haptic_node on theatre-2"; nothing when nobody does. A claim that is
/// held gives way to nobody. Before, it gives way to every node of a session, to a launcher that holds the
/// domain, and of two that listen the later one to the earlier: whatever their clocks say, one of them stays.
std::optional<std::string> better_claim(const DomainClaim& own, const msg::NodeStatus& other);

}  // namespace omentum::session
