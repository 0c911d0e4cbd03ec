// Blocks of an inverse that were asked for before.
#pragma once

#include "geometry/types.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace omentum::physics {

/// The last few blocks, by their nodes: a tool that stays where it is asks for the same one again and again.
/// Blocks are [3n x 3n], n the nodes. All memory is taken at construction; one thread at a time.
class KnownBlocks {
 public:
  explicit KnownBlocks(int most_nodes);

  /// False: none of these nodes, in whatever order, is known.
  [[nodiscard]] bool find(std::span<const geometry::NodeId> nodes, std::span<float> block) const noexcept;
  /// In place of the oldest.
  void keep(std::span<const geometry::NodeId> nodes, std::span<const float> block) noexcept;
  /// They are of another matrix.
  void forget() noexcept;

 private:
  struct Known {
    std::vector<geometry::NodeId> nodes;  // capacity `most_nodes`; none: unused
    std::vector<float> block;
  };
  static constexpr std::size_t kTools = 8;

  std::array<Known, kTools> known_;
  std::size_t oldest_ = 0;
};

}  // namespace omentum::physics
