#include "node_common/rivals.h"

#include <algorithm>
#include <tuple>

namespace omentum::node {

Standing standing_of(std::uint64_t ticks, double rate_hz) noexcept {
  const bool settled = rate_hz > 0 && static_cast<double>(ticks) >= kSettled_s * rate_hz;
  return settled ? Standing::kSettled : Standing::kYoung;
}

Claim claim_of(const msg::NodeStatus& status) noexcept {
  return {status.instance, standing_of(status.ticks, status.rate_hz)};
}

bool goes_before(const Claim& one, const Claim& other) noexcept {
  return one.standing == other.standing ? one.instance < other.instance : one.standing > other.standing;
}

bool Rivals::proven(const msg::NodeStatus& status, std::int64_t now_ns) noexcept {
  if (!is_one(status)) return false;
  Heard& rival = place_of(status.instance, now_ns);
  if (rival.rises < 0 || now_ns - rival.newest_ns > kSilence_ns) {
    rival = {status.instance, status.ticks, now_ns, now_ns, 0};
    return false;
  }
  if (status.ticks <= rival.ticks) return false;
  ++rival.rises;
  rival.ticks = status.ticks;
  rival.newest_ns = now_ns;
  return rival.rises >= kRises && now_ns - rival.since_ns >= kProof_ns;
}

Rivals::Heard& Rivals::place_of(std::uint64_t instance, std::int64_t now_ns) noexcept {
  const auto known = std::find_if(heard_.begin(), heard_.end(), [instance](const Heard& rival) {
    return rival.rises >= 0 && rival.instance == instance;
  });
  if (known != heard_.end()) return *known;
  // who proved most is forgotten last: names that were heard once do not hide a living node
  const auto worth = [now_ns](const Heard& rival) {
    const bool silent = now_ns - rival.newest_ns > kSilence_ns;
    return std::tuple(silent ? -1 : rival.rises, rival.newest_ns);
  };
  Heard& least = *std::min_element(heard_.begin(), heard_.end(),
                                   [&](const Heard& a, const Heard& b) { return worth(a) < worth(b); });
  least = Heard{};
  return least;
}

}  // namespace omentum::node
