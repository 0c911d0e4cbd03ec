// Tools around which a reset brings tissue back.
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// How long after a reset an organ as it was may be followed by the one as it is, s: deform_node may hear of
/// it later than haptic_node, and tells that there is nothing for 0.1 s (deform_node/local_publisher.h).
inline constexpr double kTissueBack_s = 0.5;

/// A person resets the session. What is inside of a body while its tissue comes back did not go in, and never
/// pressed on its way: it presses nothing, holds nothing back and is not pushed out until it was outside
/// once, however the hand goes on. (Of a device or a node that was started again nobody knows that; its tools
/// are held back from going deeper: meet_appeared.)
void expect_tissue_back(std::int64_t now_ns, HapticState& state) noexcept;

inline bool tissue_comes_back(const HapticState& state) noexcept {
  return state.now_ns < state.tissue_back_until_ns;
}
/// The point is outside. While tissue comes back that is outside of what was cut.
inline void note_outside(const HapticState& state, PointMemory& memory) noexcept {
  memory.enclosed = memory.enclosed && tissue_comes_back(state);
}

}  // namespace omentum::haptic
