// One deform_node serves a scene; another one with the same organs stands by.
#pragma once

#include "node_common/rivals.h"

#include <atomic>

namespace omentum::deform {

/// Says whether another deform_node serves. node::goes_before decides between two; who stands by takes over
/// once the other one has told no status for node::Rivals::kSilence_ns, however it ended. Unlike a hand's
/// tool a scene may be left by a settled node too: no force hangs on it, and it is taken up again when the
/// other one falls silent. So two that meet late (one was frozen, or their networks joined) do not both go
/// on.
///
/// hear() may run on one thread beside the loop's; nothing waits or allocates. Reads no clock.
class Standby {
 public:
  explicit Standby(std::uint64_t instance) noexcept
      : instance_(instance), rivals_(msg::NODE_DEFORM, instance) {}

  /// The status reader's thread. While this node serves, only a proven claim counts (node::Rivals); before
  /// that any does, since a wrong one costs a second.
  void hear(const msg::NodeStatus& other, std::int64_t now_ns) noexcept;

  /// The loop's thread.
  bool other_serves(std::int64_t now_ns) const noexcept;
  /// This node serves and tells so / has stepped back.
  void serving(const msg::NodeStatus& own) noexcept;
  void stepped_back() noexcept { standing_.store(node::Standing::kListening, std::memory_order_relaxed); }

 private:
  std::uint64_t instance_;
  node::Rivals rivals_;  // the status reader's
  std::atomic<node::Standing> standing_{node::Standing::kListening};
  std::atomic<std::int64_t> heard_ns_{0};  // the newest claim that goes before this node's; 0: none
};

}  // namespace omentum::deform
