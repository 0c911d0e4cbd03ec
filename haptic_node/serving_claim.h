// Two haptic nodes must not answer for one tool, and no node may join a scene with another organ.
#pragma once

#include "transport/messages.h"

#include <optional>
#include <string>

namespace omentum::haptic {

/// What this node claims to be and to serve.
struct ServingClaim {
  std::uint64_t instance = 0;      // start time, ns, wall clock: the older node keeps its tools
  std::uint32_t tools_served = 0;  // bit t: answers for tool t
  std::string organ_hash;
};

/// Why the other node's claim is the better one; nothing when both can live. Of two haptic nodes with a tool
/// in common the younger one yields.
std::optional<std::string> yields_to(const ServingClaim& own, const msg::NodeStatus& other);

/// Why this node must not take part: another protocol, or another organ file (both hashes are named).
std::optional<std::string> contradicts(const ServingClaim& own, const msg::SceneInfo& scene);

}  // namespace omentum::haptic
