#include "haptic_node/serving_claim.h"

#include <bit>

namespace omentum::haptic {

Dispute judge(const ServingClaim& own, const msg::NodeStatus& other) noexcept {
  const std::uint32_t common = own.tools_served & other.tools_served;
  const bool keeps =
      own.claim.standing == node::Standing::kSettled || node::goes_before(own.claim, node::claim_of(other));
  return keeps ? Dispute{.given_up = 0, .kept = common} : Dispute{.given_up = common, .kept = 0};
}

std::string nothing_left(const Dispute& dispute, const msg::NodeStatus& other) {
  return "tool " + std::to_string(std::countr_zero(dispute.given_up)) +
         " is already served by the haptic_node on host " + other.host + " (instance " +
         std::to_string(other.instance) + "), and no tool is left";
}

}  // namespace omentum::haptic
