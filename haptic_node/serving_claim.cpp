#include "haptic_node/serving_claim.h"

#include <bit>

namespace omentum::haptic {

Standing standing_of(std::uint64_t ticks, double rate_hz) {
  return static_cast<double>(ticks) >= kSettled_s * rate_hz ? Standing::kSettled : Standing::kYoung;
}

std::optional<std::string> yields_to(const ServingClaim& own, const msg::NodeStatus& other) {
  if (other.kind != msg::NODE_HAPTIC || other.instance == own.instance) return std::nullopt;
  const std::uint32_t common = own.tools_served & other.tools_served;
  if (common == 0) return std::nullopt;
  const Standing theirs = standing_of(other.ticks, other.rate_hz);
  const bool keeps = own.standing == theirs ? own.instance < other.instance : own.standing > theirs;
  if (keeps) return std::nullopt;
  return "tool " + std::to_string(std::countr_zero(common)) +
         " is already served by the haptic_node on host " + other.host + " (instance " +
         std::to_string(other.instance) + ")";
}

std::optional<std::string> contradicts(const ServingClaim& own, const msg::SceneInfo& scene) {
  if (scene.protocol != msg::PROTOCOL_VERSION) {
    return "deform_node speaks protocol " + std::to_string(scene.protocol) + ", this node speaks " +
           std::to_string(msg::PROTOCOL_VERSION);
  }
  const std::string theirs = scene.organs.empty() ? "none" : scene.organs.front().hash;
  if (theirs == own.organ_hash) return std::nullopt;
  return "deform_node loaded another organ file: its hash is " + theirs + ", this node's is " +
         own.organ_hash;
}

}  // namespace omentum::haptic
