// What the step's contacts look like on the wire.
#pragma once

#include "haptic_node/haptic_step.h"
#include "transport/messages.h"

namespace omentum::haptic {

/// A message with room for every node that one tool can touch: filling it allocates nothing.
msg::Contact make_contact_message(std::uint32_t tool_id);

/// This tool's forces, and what all tools together move its nodes by: u_A = C_AA f_A. Pinned nodes, which
/// nothing moves, are left out. No allocation on a message from make_contact_message.
void fill_contact_message(const HapticModel& model, std::int32_t tool, const ToolOutput& output,
                          const HapticState& state, HapticWorkspace& work, msg::Contact& message) noexcept;

}  // namespace omentum::haptic
