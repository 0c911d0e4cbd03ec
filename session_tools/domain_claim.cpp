#include "session_tools/domain_claim.h"

#include <array>
#include <tuple>

namespace omentum::session {

namespace {

std::string name_of(const msg::NodeStatus& status) {
  constexpr std::array<const char*, 5> kNames{"haptic_node", "deform_node", "render_node", "a device",
                                              "a launcher"};
  const std::string kind = status.kind < kNames.size() ? kNames[status.kind] : "a node";
  return status.host.empty() ? kind : kind + " on " + status.host;
}

bool goes_before(const msg::NodeStatus& other, const DomainClaim& own) {
  if (other.kind != msg::NODE_LAUNCHER || other.ticks > 0) return true;
  return std::tie(other.instance, other.host) < std::tie(own.instance, own.host);
}

}  // namespace

msg::NodeStatus status_of(const DomainClaim& claim) {
  msg::NodeStatus status;
  status.kind = msg::NODE_LAUNCHER;
  status.instance = claim.instance;
  status.host = claim.host;
  status.ticks = claim.held ? 1 : 0;
  return status;
}

std::optional<std::string> better_claim(const DomainClaim& own, const msg::NodeStatus& other) {
  const bool itself =
      other.kind == msg::NODE_LAUNCHER && other.instance == own.instance && other.host == own.host;
  if (own.held || itself || !goes_before(other, own)) return std::nullopt;
  return name_of(other);
}

}  // namespace omentum::session
