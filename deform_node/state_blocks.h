// How an organ's state is cut into messages.
#pragma once

#include "transport/bus.h"

#include <cstdint>
#include <vector>

namespace omentum::deform {

/// Surface nodes [first, first + count) of one OrganState.
struct StateBlock {
  std::int32_t first = 0;
  std::int32_t count = 0;
};

/// One block on loopback (as far as a message can hold it); on a LAN blocks that fit one datagram, so that
/// a lost packet costs a block of one frame and not the frame.
std::int32_t nodes_per_block(transport::Profile profile);

/// Covers every node once, in order. An organ without nodes is one empty block.
std::vector<StateBlock> split_state(std::int32_t node_count, std::int32_t nodes_per_block);

}  // namespace omentum::deform
