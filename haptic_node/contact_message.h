// What the step's contacts look like on the wire.
#pragma once

#include "haptic_node/haptic_step.h"
#include "transport/messages.h"

namespace omentum::haptic {

/// A message with room for every node that one tool can touch: filling it allocates nothing.
msg::Contact make_contact_message(std::uint32_t tool_id, std::uint32_t organ);

/// Whether the tool presses or holds the organ.
bool touches(std::int32_t tool, std::uint32_t organ, const HapticState& state, Bodies& bodies) noexcept;

/// This tool's forces on one organ (message.organ), and what all tools together move its nodes by: u_A = C_AA
/// f_A. Pinned nodes, which nothing moves, are left out. `grasping` says whether the jaws hold this organ;
/// `grasp_count` counts the tool's grasps, of any organ. No allocation on a message from
/// make_contact_message.
void fill_contact_message(std::int32_t tool, const ToolOutput& output, const HapticState& state,
                          Bodies& bodies, msg::Contact& message) noexcept;

}  // namespace omentum::haptic
