// Others that say they do what this node does: whose word counts, and who steps back.
#pragma once

#include "transport/messages.h"

#include <array>
#include <cstdint>

namespace omentum::node {

/// How long a node that serves must have run before a newcomer cannot move it, s: two Fast participants find
/// each other within 2.9 s, so that a settled node never is the one that came later.
inline constexpr double kSettled_s = 5;

enum class Standing : std::uint8_t {
  kListening,  // serves nobody yet
  kYoung,      // serves, but may not have met everyone
  kSettled,
};

/// The standing of a node that serves, from its own count of ticks: both sides of a dispute judge by the same
/// numbers, and no two machines' clocks are compared.
Standing standing_of(std::uint64_t ticks, double rate_hz) noexcept;

/// A node that serves, or would.
struct Claim {
  std::uint64_t instance = 0;  // start time, ns, wall clock
  Standing standing = Standing::kListening;
};
Claim claim_of(const msg::NodeStatus& status) noexcept;

/// Whether `one` serves rather than `other`: the higher standing, and among equals, which started together or
/// whose networks met late, the smaller instance. Of two different claims exactly one goes before the other.
bool goes_before(const Claim& one, const Claim& other) noexcept;

/// A status is a sample, and anybody can write one. A claim counts only once it was repeated over kProof_ns
/// by somebody whose loop ticks meanwhile, and for as long as it is. Reads no clock; one thread, nothing
/// waits or allocates.
class Rivals {
 public:
  /// Three of the statuses that a serving node tells ten times a second, ns.
  static constexpr std::int64_t kProof_ns = 300'000'000;
  /// Who tells nothing for so long does not serve, ns: ten of those statuses.
  static constexpr std::int64_t kSilence_ns = 1'000'000'000;

  /// The rivals of the node of `kind` (msg::NODE_*) that is `instance` itself.
  Rivals(std::uint32_t kind, std::uint64_t instance) noexcept : kind_(kind), instance_(instance) {}

  /// Whether the status is a rival's: of another node of this kind.
  bool is_one(const msg::NodeStatus& status) const noexcept {
    return status.kind == kind_ && status.instance != instance_;
  }
  /// Hears a status; whether it is a rival's claim that counts.
  bool proven(const msg::NodeStatus& status, std::int64_t now_ns) noexcept;

 private:
  struct Heard {
    std::uint64_t instance = 0, ticks = 0;
    std::int64_t since_ns = 0, newest_ns = 0;
    int rises = -1;  // how often the ticks were more than before; -1: nothing was heard
  };
  // more of them at once are no session
  static constexpr std::size_t kRemembered = 8;
  static constexpr int kRises = 2;  // so that two samples prove nothing, however far apart

  Heard& place_of(std::uint64_t instance, std::int64_t now_ns) noexcept;

  std::uint32_t kind_;
  std::uint64_t instance_;
  std::array<Heard, kRemembered> heard_{};
};

}  // namespace omentum::node
