#include "deform_node/state_blocks.h"

#include <algorithm>

namespace omentum::deform {

namespace {

constexpr std::int32_t kFloatsPerNode = 3;
constexpr std::int32_t kBytesPerNode = kFloatsPerNode * 4;
/// An RTPS message on the profile `lan` is at most 1,300 bytes of payload (transport's fragment size).
constexpr std::int32_t kDatagramBytes = 1300;
/// What an OrganState carries beside its values: headers and an echo of 24 bytes for each tool.
constexpr std::int32_t kOverheadBytes = 128 + 24 * static_cast<std::int32_t>(msg::MAX_TOOLS);
constexpr std::int32_t kLanNodes = (kDatagramBytes - kOverheadBytes) / kBytesPerNode;
constexpr std::int32_t kLoopbackNodes = static_cast<std::int32_t>(msg::MAX_BLOCK_FLOATS) / kFloatsPerNode;

}  // namespace

std::int32_t nodes_per_block(transport::Profile profile) {
  return profile == transport::Profile::kLan ? kLanNodes : kLoopbackNodes;
}

std::vector<StateBlock> split_state(std::int32_t node_count, std::int32_t nodes_per_block) {
  std::vector<StateBlock> blocks;
  for (std::int32_t first = 0; first < node_count; first += nodes_per_block)
    blocks.push_back({first, std::min(nodes_per_block, node_count - first)});
  if (blocks.empty()) blocks.push_back({});
  return blocks;
}

}  // namespace omentum::deform
