#include "deform_node/organ_messages.h"

#include <algorithm>

namespace omentum::deform {

namespace {

static_assert(static_cast<std::uint32_t>(StateKind::kSurface) == msg::KIND_SURFACE);
static_assert(static_cast<std::uint32_t>(StateKind::kTube) == msg::KIND_TUBE);

// Which of the tetrahedra are removed now and were not before, as far as a message can hold them.
void list_added(const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& now,
                std::vector<std::uint32_t>& added) {
  added.clear();
  for (std::size_t byte = 0; byte < now.size(); ++byte) {
    const unsigned fresh = now[byte] & ~static_cast<unsigned>(before[byte]);
    for (unsigned bit = 0; fresh >> bit != 0 && added.size() < msg::MAX_LAST_REMOVED; ++bit)
      if (fresh >> bit & 1u) added.push_back(static_cast<std::uint32_t>(8 * byte + bit));
  }
}

}  // namespace

OrganMessages::OrganMessages(std::uint32_t organ, std::uint32_t tetrahedron_count, std::int32_t most_nodes)
    : organ_(organ), most_nodes_(most_nodes), settled_bits_((std::size_t{tetrahedron_count} + 7) / 8, 0) {
  topology_.organ = organ;
  topology_.tetrahedron_count = tetrahedron_count;
  topology_.removed_bits = settled_bits_;
}

const msg::Topology* OrganMessages::unsettled_topology(const OrganSnapshot& snapshot) {
  if (settled_ == snapshot.topology_version) return nullptr;
  std::vector<std::uint8_t>& removed = topology_.removed_bits;
  topology_.version = snapshot.topology_version;
  std::copy_n(snapshot.removed_bits.begin(), std::min(snapshot.removed_bits.size(), removed.size()),
              removed.begin());
  topology_.burnt_bits.assign(snapshot.burnt_bits.begin(), snapshot.burnt_bits.end());
  list_added(settled_bits_, removed, topology_.last_removed);
  return &topology_;
}

void OrganMessages::settle_topology() {
  settled_ = topology_.version;
  settled_bits_ = topology_.removed_bits;
}

const std::vector<msg::OrganState>& OrganMessages::blocks_of(const TickSnapshot& tick) {
  const OrganSnapshot& snapshot = tick.organs[organ_];
  if (blocks_.empty() || 3 * std::size_t{blocks_.front().node_count} != snapshot.value_count)
    split(snapshot.value_count);
  for (msg::OrganState& block : blocks_) {
    block.seq = tick.seq;
    block.stamp_ns = tick.stamp_ns;
    block.topology_version = snapshot.topology_version;
    block.kind = static_cast<std::uint32_t>(snapshot.kind);
    const auto echoes = tick.echoes.all();
    block.echoes.assign(echoes.begin(), echoes.end());
    std::copy_n(snapshot.values.begin() + 3 * static_cast<std::ptrdiff_t>(block.first), block.values.size(),
                block.values.begin());
  }
  return blocks_;
}

void OrganMessages::split(std::size_t value_count) {
  const auto node_count = static_cast<std::int32_t>(value_count / 3);
  const std::vector<StateBlock> places = split_state(node_count, most_nodes_);
  blocks_.assign(places.size(), {});
  for (std::size_t b = 0; b < places.size(); ++b) {
    blocks_[b].organ = organ_;
    blocks_[b].block = static_cast<std::uint32_t>(b);
    blocks_[b].block_count = static_cast<std::uint32_t>(places.size());
    blocks_[b].first = static_cast<std::uint32_t>(places[b].first);
    blocks_[b].node_count = static_cast<std::uint32_t>(node_count);
    blocks_[b].values.resize(3 * static_cast<std::size_t>(places[b].count));
  }
}

}  // namespace omentum::deform
