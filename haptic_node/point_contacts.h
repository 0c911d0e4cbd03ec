// All tools' contacts solved together, each tool's point on its material point.
#pragma once

#include "haptic_node/tool_contact.h"

namespace omentum::haptic {

/// Forces and gaps of all contacts, and the forces on the nodes below them, from the gaps without the
/// tissue's displacement (`work.free_gaps`) and the last tick's forces. The contacts behind the first `near`
/// are open as far as one can tell: the problem is solved without them, which costs a fraction, and with them
/// where that cannot be proved.
physics::ContactSolution solve_point_contacts(const HapticModel& model, std::span<const ToolInput> inputs,
                                              int near, HapticState& state, HapticWorkspace& work) noexcept;

}  // namespace omentum::haptic
