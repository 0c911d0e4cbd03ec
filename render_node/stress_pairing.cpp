#include "render_node/stress_pairing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace omentum::render {
namespace {

void put(const std::vector<float>& part, std::uint32_t first, std::vector<float>& whole) {
  std::copy(part.begin(), part.end(), whole.begin() + std::ptrdiff_t{first});
}

bool all_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

std::optional<AssembledState> StressPairing::take(const AssembledState& state, std::int64_t now_ns) {
  if (belong_together(state)) return with_values(state, now_ns);
  std::erase_if(heard_, [&](const Heard& heard) { return now_ns - heard.arrived_ns > kPatience_ns; });
  const bool waits = paired_ns_ && now_ns - *paired_ns_ <= kPatience_ns;
  heard_.push_back({state, now_ns, !waits});
  return waits ? std::nullopt : std::optional(state);
}

bool StressPairing::take(const msg::OrganStress& block) {
  if (!fits(block)) return false;
  if (!continues(block)) begin(block);
  if (arrived_[block.block]) return true;
  put(block.strains, block.first, strain_);
  if (!stress_pa_.empty()) put(block.stresses, block.first, stress_pa_);
  arrived_[block.block] = true;
  --missing_blocks_;
  return true;
}

std::optional<AssembledState> StressPairing::pair(std::int64_t now_ns) {
  const auto found = std::find_if(heard_.begin(), heard_.end(),
                                  [this](const Heard& heard) { return belong_together(heard.state); });
  if (found == heard_.end()) return std::nullopt;
  paired_ns_ = now_ns;
  // who has seen a newer one does not go back; from here on states wait
  const bool is_past = found->is_shown && found + 1 != heard_.end();
  AssembledState state = std::move(found->state);
  heard_.erase(heard_.begin(), found + 1);
  return is_past ? std::nullopt : std::optional(with_values(std::move(state), now_ns));
}

bool StressPairing::fits(const msg::OrganStress& block) const {
  const std::size_t end = std::size_t{block.first} + block.strains.size();
  return block.node_count <= most_nodes_ && end <= block.node_count && block.block < block.block_count &&
         block.block_count <= std::max(block.node_count, 1u) &&
         (block.stresses.empty() || block.stresses.size() == block.strains.size()) &&
         all_finite(block.strains) && all_finite(block.stresses);
}

bool StressPairing::continues(const msg::OrganStress& block) const {
  return block.seq == seq_ && block.topology_version == topology_version_ &&
         block.node_count == strain_.size() && block.block_count == arrived_.size() &&
         block.stresses.empty() == stress_pa_.empty();
}

void StressPairing::begin(const msg::OrganStress& block) {
  seq_ = block.seq;
  topology_version_ = block.topology_version;
  missing_blocks_ = block.block_count;
  arrived_.assign(block.block_count, false);
  strain_.assign(block.node_count, 0.0f);
  stress_pa_.assign(block.stresses.empty() ? 0 : block.node_count, 0.0f);
}

bool StressPairing::belong_together(const AssembledState& state) const {
  return missing_blocks_ == 0 && !arrived_.empty() && !state.values.empty() && state.seq == seq_ &&
         state.topology_version == topology_version_ && state.values.size() == 3 * strain_.size();
}

AssembledState StressPairing::with_values(AssembledState state, std::int64_t now_ns) {
  paired_ns_ = now_ns;
  state.strain = strain_;
  state.stress_pa = stress_pa_;
  return state;
}

}  // namespace omentum::render
