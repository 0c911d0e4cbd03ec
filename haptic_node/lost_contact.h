// Contacts that are no longer where their tool is, and tools inside the organ without a contact.
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// Lets go of contacts whose material point is no longer where the tool is. One that slides keeps up with its
/// point; sliding goes from triangle to triangle, though, and the point may be on another side by then (it
/// went through a lobe, around a border, or far in one tick). Where such points are is asked anew by
/// meet_appeared in the next tick, whose surface is without their force. Contacts that hold a depth without
/// force are asked by turns whether the surface point nearest to them is still theirs. A point that has gone
/// through the organ (tissue_ahead), or whose side of the organ was drawn through the other one, holds
/// nothing until it comes in again. Between two jaws tissue is squeezed and held from both sides: that is no
/// passage.
void leave_astray(const HapticModel& model, HapticState& state, Bodies& bodies) noexcept;

/// Points that are inside the organ without having come there by moving (a device or node that was started
/// again, or a contact that went astray): each holds the nearest surface point from where it is. It is not
/// pushed out, is held back from going deeper at once, may leave freely, and outside is a point like any
/// other. What of a tool's points would leave through another side of the organ than most holds nothing until
/// it left.
void meet_appeared(HapticState& state, Bodies& bodies) noexcept;

/// A tool that appeared inside and goes out takes the depth with it that is no press. Only once nothing
/// pushes it any more: what one point gave up while another still pressed would push later, with energy from
/// nowhere.
void surface_with_tools(HapticState& state, Bodies& bodies) noexcept;

}  // namespace omentum::haptic
