// What a hand is told of how a patch yields.
#pragma once

#include "deform_node/local_patch.h"

#include <span>

namespace omentum::deform {

/// Writes the upper triangle of `block`, [3n x 3n], m/N, of the patch's n nodes into it. Supports yield a
/// millionth of what else does, in `block` too. False: it is softer than any tissue, or no number, and is not
/// to be told.
[[nodiscard]] bool tell_compliance(std::span<float> block, LocalPatch& patch) noexcept;

}  // namespace omentum::deform
