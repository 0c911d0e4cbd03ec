// What the other tools do to the tissue that a tool meets. A mesh knows one dent per node; of each, the part
// that no neighbour shares belongs to the tool that makes it (ContactNodes::own_compliance).
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// Finds out what other tools' own dents there are around tool `tool` on its way in `path`:
/// ToolState::others_m and near_others. An own dent reaches as far as its node's facets. No allocation.
void look_for_other_tools(const Region& path, std::int32_t tool, HapticState& state, Bodies& bodies) noexcept;

/// Whether any two tools may press the same nodes.
bool any_near_others(const HapticState& state) noexcept;

/// After a solve whose forces the contacts and nodes carry: each tool's own dents (NodeForce::dent), and what
/// the others' are at a contact's material point, which its tool does not meet (ToolContact::other_dents). No
/// allocation.
void measure_other_tools(BodyId id, Body& body, HapticState& state) noexcept;

}  // namespace omentum::haptic
