#include "render_node/state_assembly.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {

StateAssembly::StateAssembly(std::uint32_t kind, NodeCounts counts, double reach_m)
    : kind_(kind), counts_(counts), reach_m_(static_cast<float>(reach_m)) {
  state_.values.assign(3 * counts.whole, 0.0f);
  may_lack_blocks_ =
      kind == msg::KIND_SURFACE;  // whose zeros are the organ at rest; places have no such start
}

StateAssembly::Outcome StateAssembly::take(const msg::OrganState& block,
                                           const std::function<void(const AssembledState&)>& show) {
  if (!fits(block)) return Outcome::kMisfit;
  if (arrived_.empty() || block.seq != state_.seq) {
    if (!arrived_.empty() && !newer(block)) return Outcome::kLate;
    if (state_.missing_blocks > 0 && may_lack_blocks_) show(state_);
    begin(block);
  }
  if (!of_this_state(block)) return Outcome::kMisfit;
  late_in_a_row_ = 0;
  if (arrived_.size() != block.block_count || arrived_[block.block]) return Outcome::kLate;  // a duplicate
  std::copy(block.values.begin(), block.values.end(),
            state_.values.begin() + 3 * std::ptrdiff_t{block.first});
  arrived_[block.block] = true;
  if (--state_.missing_blocks == 0) {
    may_lack_blocks_ = true;
    show(state_);
  }
  return Outcome::kTaken;
}

bool StateAssembly::fits(const msg::OrganState& block) const {
  return block.kind == kind_ && block.node_count >= counts_.whole && block.node_count <= counts_.most &&
         block.block < block.block_count && block.block_count <= std::max(block.node_count, 1u) &&
         3 * std::size_t{block.first} + block.values.size() <= 3 * std::size_t{block.node_count} &&
         std::all_of(block.values.begin(), block.values.end(),
                     [this](float x) { return std::abs(x) <= reach_m_; });
}

bool StateAssembly::of_this_state(const msg::OrganState& block) const {
  return 3 * std::size_t{block.node_count} == state_.values.size() &&
         block.topology_version == state_.topology_version;
}

bool StateAssembly::newer(const msg::OrganState& block) {
  if (block.seq > state_.seq || block.stamp_ns > state_.stamp_ns) return true;
  return ++late_in_a_row_ > kPatience;
}

void StateAssembly::begin(const msg::OrganState& block) {
  if (!of_this_state(block)) {
    state_.topology_version = block.topology_version;
    state_.values.assign(3 * std::size_t{block.node_count}, 0.0f);
    may_lack_blocks_ = false;
  }
  state_.seq = block.seq;
  state_.stamp_ns = block.stamp_ns;
  state_.echoes = block.echoes;
  state_.missing_blocks = block.block_count;
  arrived_.assign(block.block_count, false);
}

std::vector<msg::Echo> merge_echoes(const std::vector<std::vector<msg::Echo>>& of_organs) {
  std::vector<msg::Echo> merged;
  for (const auto& echoes : of_organs) {
    for (const msg::Echo& echo : echoes) {
      if (echo.tool >= msg::MAX_TOOLS) continue;  // NodeStatus has room for no more
      const auto same =
          std::find_if(merged.begin(), merged.end(), [&](const auto& m) { return m.tool == echo.tool; });
      if (same == merged.end()) {
        merged.push_back(echo);
      } else if (echo.stamp_ns > same->stamp_ns) {
        *same = echo;
      }
    }
  }
  return merged;
}

}  // namespace omentum::render
