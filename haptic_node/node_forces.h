// Forces on surface nodes, tool by tool and all tools' together.
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic {

/// Adds a force on a node; the same node's from the same tool are one entry.
void add_node_force(HapticState& state, SurfaceId node, std::int32_t tool, const Vec3& force) noexcept;

/// Proposes to the surface all tools' forces on each node together.
void propose_forces(const HapticState& state, DeformedSurface& surface) noexcept;

}  // namespace omentum::haptic
