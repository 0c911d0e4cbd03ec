#include "haptic_node/node_forces.h"

#include <algorithm>

namespace omentum::haptic {

void add_node_force(HapticState& state, SurfaceId node, std::int32_t tool, const Vec3& force) noexcept {
  for (int q = 0; q < state.node_force_count; ++q) {
    NodeForce& entry = state.node_forces[q];
    if (entry.node == node && entry.tool == tool) {
      entry.force += force;
      return;
    }
  }
  state.node_forces[state.node_force_count++] = {node, tool, force, Vec3::Zero()};
}

void propose_forces(const HapticState& state, DeformedSurface& surface) noexcept {
  std::array<SurfaceId, DeformedSurface::kMaxForces> nodes;
  std::array<Vec3, DeformedSurface::kMaxForces> forces;
  std::size_t count = 0;
  for (const NodeForce& entry : state.forces()) {
    const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(count);
    const auto at = static_cast<std::size_t>(std::find(nodes.begin(), end, entry.node) - nodes.begin());
    if (at < count) {
      forces[at] += entry.force;
    } else {
      nodes[count] = entry.node;
      forces[count++] = entry.force;
    }
  }
  surface.propose({nodes.data(), count}, {forces.data(), count});
}

}  // namespace omentum::haptic
