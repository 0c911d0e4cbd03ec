// Which tetrahedra of a mesh are left.
#pragma once

#include "geometry/tetra_bits.h"
#include "geometry/tetra_links.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::geometry {

/// A subset of a mesh's tetrahedra, all of them at first, with the number of those around each node. Takes
/// its memory when it is made. `links` outlives it.
class RemainingTetrahedra {
 public:
  explicit RemainingTetrahedra(const TetraLinks& links)
      : links_(links),
        bits_((static_cast<std::size_t>(links.tetrahedron_count()) + 7) / 8, 0),
        uses_(static_cast<std::size_t>(links.node_count())) {
    for (std::int32_t n = 0; n < links.node_count(); ++n) {
      uses_[static_cast<std::size_t>(n)] = static_cast<std::int32_t>(links.around(NodeId(n)).size());
    }
  }

  const TetraLinks& links() const noexcept { return links_; }

  bool has(TetId t) const noexcept { return !is_set(bits_, t); }

  /// Whether the neighbour is one, and left.
  bool has_neighbour(TetId t) const noexcept { return t.valid() && has(t); }

  /// Precondition: it is left.
  void take(TetId t) noexcept { flip(t, 1); }
  /// Precondition: it was taken.
  void put_back(TetId t) noexcept { flip(t, -1); }

  std::int32_t removed_count() const noexcept { return removed_; }
  std::span<const std::uint8_t> removed_bits() const noexcept { return bits_; }
  std::int32_t uses(NodeId n) const noexcept { return uses_[static_cast<std::size_t>(n)]; }

 private:
  void flip(TetId t, std::int32_t removed) noexcept {
    const std::size_t i = static_cast<std::size_t>(t);
    bits_[i / 8] = static_cast<std::uint8_t>(bits_[i / 8] ^ (1u << (i % 8)));
    removed_ += removed;
    for (const NodeId n : links_.nodes(t)) uses_[static_cast<std::size_t>(n)] -= removed;
  }

  const TetraLinks& links_;
  std::vector<std::uint8_t> bits_;  // [(T + 7) / 8], set: removed
  std::vector<std::int32_t> uses_;  // [N]
  std::int32_t removed_ = 0;
};

}  // namespace omentum::geometry
