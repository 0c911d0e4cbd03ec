#include "render_node/known_topologies.h"

#include <algorithm>

namespace omentum::render {
namespace {

bool none_set(const std::vector<std::uint8_t>& bits) {
  return std::all_of(bits.begin(), bits.end(), [](std::uint8_t byte) { return byte == 0; });
}

bool within(const std::vector<std::uint8_t>& part, const std::vector<std::uint8_t>& whole) {
  for (std::size_t i = 0; i < part.size(); ++i) {
    const unsigned there = i < whole.size() ? whole[i] : 0u;
    if ((part[i] & ~there) != 0) return false;
  }
  return true;
}

}  // namespace

bool RemovedSet::whole() const {
  return none_set(bits);
}

bool KnownTopologies::take(const msg::Topology& topology) {
  if (topology.tetrahedron_count != tetrahedron_count_ || !fits(topology.removed_bits) ||
      !within(topology.burnt_bits, topology.removed_bits))
    return false;
  if (topology.version != known_[0].version) std::swap(known_[0], known_[1]);
  known_[0] = {topology.version, {topology.removed_bits, topology.burnt_bits}};
  return true;
}

bool KnownTopologies::fits(const std::vector<std::uint8_t>& bits) const {
  if (bits.size() > (tetrahedron_count_ + 7) / 8) return false;
  const std::size_t in_last = tetrahedron_count_ % 8;
  return in_last == 0 || bits.size() * 8 <= tetrahedron_count_ || bits.back() >> in_last == 0;
}

const RemovedSet* KnownTopologies::removed_in(std::uint64_t version) const {
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.version == version; });
  return known == known_.end() ? nullptr : &known->removed;
}

std::uint64_t KnownTopologies::highest() const {
  return std::max(known_[0].version, known_[1].version);
}

}  // namespace omentum::render
