#include "deform_node/state_blocks.h"

#include "transport/topics.h"

#include <algorithm>

namespace omentum::deform {

std::int32_t nodes_per_block(transport::Profile profile) {
  return static_cast<std::int32_t>(transport::organ_block_floats(profile) / 3);
}

std::vector<StateBlock> split_state(std::int32_t node_count, std::int32_t nodes_per_block) {
  std::vector<StateBlock> blocks;
  for (std::int32_t first = 0; first < node_count; first += nodes_per_block)
    blocks.push_back({first, std::min(nodes_per_block, node_count - first)});
  if (blocks.empty()) blocks.push_back({});
  return blocks;
}

}  // namespace omentum::deform
