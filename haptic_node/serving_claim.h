// Two haptic nodes must not answer for one tool, and no node may join a scene with another organ.
#pragma once

#include "transport/messages.h"

#include <optional>
#include <string>

namespace omentum::haptic {

/// How long a node that answers must have run before a newcomer cannot move it, s: two Fast participants find
/// each other within 2.9 s, so that a settled node never is the one that came later.
inline constexpr double kSettled_s = 5;

enum class Standing {
  kListening,  // serves nobody yet
  kYoung,      // serves, but may not have met everyone
  kSettled,
};

/// The standing of a node that serves, from its own count of ticks: both sides of a dispute judge by the same
/// numbers, and no two machines' clocks are compared.
Standing standing_of(std::uint64_t ticks, double rate_hz);

/// What this node claims to be and to serve.
struct ServingClaim {
  std::uint64_t instance = 0;      // start time, ns, wall clock
  std::uint32_t tools_served = 0;  // bit t: answers for tool t
  std::string organ_hash;
  Standing standing = Standing::kListening;
};

/// Why the other node's claim is the better one; nothing when both can live. Of two haptic nodes with a tool
/// in common, the one with the lower standing yields; of two of equal standing, which started together or
/// whose networks met late, the one with the larger instance. A haptic node tells its status only when it
/// serves: who still listens always yields.
std::optional<std::string> yields_to(const ServingClaim& own, const msg::NodeStatus& other);

/// Why this node must not take part: another protocol, or another organ file (both hashes are named).
std::optional<std::string> contradicts(const ServingClaim& own, const msg::SceneInfo& scene);

}  // namespace omentum::haptic
