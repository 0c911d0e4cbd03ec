// Forces on surface nodes, tool by tool and all tools' together.
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// Adds a force on a node; the same node's from the same tool are one entry.
void add_node_force(HapticState& state, BodyId body, SurfaceId node, std::int32_t tool,
                    const Vec3& force) noexcept;

/// Shares a contact's force by the nodes at its material point: f_v = k_v lambda.
void share_force(HapticState& state, const ToolContact& contact) noexcept;

/// Proposes to every body all tools' forces on each of its nodes together.
void propose_forces(const HapticState& state, Bodies& bodies) noexcept;
void propose_forces(const HapticState& state, BodyId id, Body& body) noexcept;

}  // namespace omentum::haptic
