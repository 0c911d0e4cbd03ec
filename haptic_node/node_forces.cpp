#include "haptic_node/node_forces.h"

#include <algorithm>

namespace omentum::haptic {

void add_node_force(HapticState& state, BodyId body, SurfaceId node, std::int32_t tool,
                    const Vec3& force) noexcept {
  for (int q = 0; q < state.node_force_count; ++q) {
    NodeForce& entry = state.node_forces[q];
    if (entry.node == node && entry.tool == tool && entry.body == body) {
      entry.force += force;
      return;
    }
  }
  state.node_forces[state.node_force_count++] = {body, node, tool, force, Vec3::Zero()};
}

void share_force(HapticState& state, const ToolContact& contact) noexcept {
  const PointNodes& at = contact.place.nodes;
  for (int v = 0; v < at.count; ++v) {
    if (at.weight[v] > 0)
      add_node_force(state, contact.body, at.node[v], contact.tool, at.weight[v] * contact.force);
  }
}

void propose_forces(const HapticState& state, BodyId id, Body& body) noexcept {
  std::array<SurfaceId, Body::kMaxForces> nodes;
  std::array<Vec3, Body::kMaxForces> forces;
  std::size_t count = 0;
  for (const NodeForce& entry : state.forces()) {
    if (entry.body != id) continue;
    const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(count);
    const auto at = static_cast<std::size_t>(std::find(nodes.begin(), end, entry.node) - nodes.begin());
    if (at < count) {
      forces[at] += entry.force;
    } else {
      nodes[count] = entry.node;
      forces[count++] = entry.force;
    }
  }
  body.propose({nodes.data(), count}, {forces.data(), count});
}

void propose_forces(const HapticState& state, Bodies& bodies) noexcept {
  bodies.for_each([&](BodyId id, Body& body) { propose_forces(state, id, body); });
}

}  // namespace omentum::haptic
