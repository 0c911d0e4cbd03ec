#include "deform_node/standby.h"

namespace omentum::deform {

void Standby::hear(const msg::NodeStatus& other, std::int64_t now_ns) noexcept {
  const node::Claim own{instance_, standing_.load(std::memory_order_relaxed)};
  const bool counts =
      rivals_.proven(other, now_ns) || (own.standing == node::Standing::kListening && rivals_.is_one(other));
  if (counts && node::goes_before(node::claim_of(other), own))
    heard_ns_.store(now_ns, std::memory_order_relaxed);
}

bool Standby::other_serves(std::int64_t now_ns) const noexcept {
  const std::int64_t heard_ns = heard_ns_.load(std::memory_order_relaxed);
  return heard_ns != 0 && now_ns - heard_ns <= node::Rivals::kSilence_ns;
}

void Standby::serving(const msg::NodeStatus& own) noexcept {
  standing_.store(node::standing_of(own.ticks, own.rate_hz), std::memory_order_relaxed);
}

}  // namespace omentum::deform
