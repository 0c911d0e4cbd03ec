// One organ's snapshots as the messages that carry them.
#pragma once

#include "deform_node/state_blocks.h"
#include "deform_node/tick_snapshot.h"

#include <optional>
#include <vector>

namespace omentum::deform {

/// Keeps the messages from state to state, so that a state of the same size takes no memory. One thread.
class OrganMessages {
 public:
  /// `organ`: index into SceneInfo.organs. `most_nodes`: of one block.
  OrganMessages(std::uint32_t organ, std::uint32_t tetrahedron_count, std::int32_t most_nodes);

  /// The topology that `snapshot` belongs to, while that is not settled; else null. A state must not leave
  /// before the topology that it numbers.
  const msg::Topology* unsettled_topology(const OrganSnapshot& snapshot);
  /// The topology left.
  void settle_topology();

  /// Organ `organ` of `tick`, in blocks; valid until the next call.
  const std::vector<msg::OrganState>& blocks_of(const TickSnapshot& tick);

 private:
  void split(std::size_t value_count);

  std::uint32_t organ_;
  std::int32_t most_nodes_;
  std::vector<msg::OrganState> blocks_;
  msg::Topology topology_;
  std::optional<std::uint64_t> settled_;    // the version that everybody was told last,
  std::vector<std::uint8_t> settled_bits_;  // and what was removed then
};

}  // namespace omentum::deform
