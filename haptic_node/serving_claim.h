// Two haptic nodes must not answer for one tool.
#pragma once

#include "node_common/rivals.h"

#include <string>

namespace omentum::haptic {

/// What this node claims to be and to serve.
struct ServingClaim {
  node::Claim claim;
  std::uint32_t tools_served = 0;  // bit t: answers for tool t
};

/// Tools that both nodes claim, bit t for tool t.
struct Dispute {
  std::uint32_t given_up = 0;  // the other node answers for them from now on
  std::uint32_t kept = 0;
};

/// What becomes of the tools that another haptic node claims as well (node::Rivals says that its claim
/// counts). Who is settled keeps them, whatever the other one says: a status can be forged, and no hand loses
/// its force in the middle of a press. Before that, node::goes_before decides. A haptic node tells its status
/// only when it serves: who still listens gives up what another one serves. Tools that are not in dispute
/// stay.
Dispute judge(const ServingClaim& own, const msg::NodeStatus& other) noexcept;

/// Why a node to which no tool is left ends.
std::string nothing_left(const Dispute& dispute, const msg::NodeStatus& other);

}  // namespace omentum::haptic
