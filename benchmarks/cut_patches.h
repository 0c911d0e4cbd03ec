// What a hand is told of a precomputed liver, whole and cut.
#pragma once

#include "deform_node/dynamic_model.h"

#include <array>

namespace omentum::bench {

/// Patches of the organ that is always in equilibrium, around two places of its surface, as deform_node tells
/// them: of the bench's mesh as it is, and with `removals` tetrahedra along a plane between them gone.
struct CutPatches {
  using Two = std::array<deform::LocalPatch, 2>;

  /// Throws std::runtime_error where the model tells no patch there.
  explicit CutPatches(std::size_t removals);

  Two whole, cut;
  std::size_t removed = 0;  // with what then hung on a node or an edge
};

}  // namespace omentum::bench
