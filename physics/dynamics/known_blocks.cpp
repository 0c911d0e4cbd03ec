#include "physics/dynamics/known_blocks.h"

#include <algorithm>

namespace omentum::physics {

using geometry::NodeId;

KnownBlocks::KnownBlocks(int most_nodes) {
  const auto nodes = static_cast<std::size_t>(most_nodes);
  for (Known& known : known_) {
    known.nodes.reserve(nodes);
    known.block.resize(9 * nodes * nodes);
  }
}

bool KnownBlocks::find(std::span<const NodeId> nodes, std::span<float> block) const noexcept {
  const auto is_same = [&](const Known& known) {
    return !nodes.empty() && std::ranges::is_permutation(nodes, known.nodes);
  };
  const auto found = std::ranges::find_if(known_, is_same);
  if (found == known_.end()) return false;
  const auto place = [&](NodeId n) {
    return static_cast<std::size_t>(std::ranges::find(found->nodes, n) - found->nodes.begin());
  };
  const std::size_t width = 3 * nodes.size();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t row = 3 * place(nodes[i]);
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const std::size_t column = 3 * place(nodes[j]);
      for (std::size_t a = 0; a < 3; ++a)
        std::copy_n(&found->block[(row + a) * width + column], 3, &block[(3 * i + a) * width + 3 * j]);
    }
  }
  return true;
}

void KnownBlocks::keep(std::span<const NodeId> nodes, std::span<const float> block) noexcept {
  Known& known = known_[oldest_];
  oldest_ = (oldest_ + 1) % kTools;
  known.nodes.assign(nodes.begin(), nodes.end());
  std::copy_n(block.begin(), 9 * nodes.size() * nodes.size(), known.block.begin());
}

void KnownBlocks::forget() noexcept {
  for (Known& known : known_) known.nodes.clear();
}

}  // namespace omentum::physics
