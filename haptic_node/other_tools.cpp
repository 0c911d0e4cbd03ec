#include "haptic_node/other_tools.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// Own dents deeper than this are met late, m: beyond any press that a linear organ means.
constexpr double kMostOthers_m = 6e-3;
// Tools this much farther apart than a facet will not share one in the next tick, wherever their contacts
// are.
constexpr double kSoon_m = 6e-3;

std::span<NodeForce> node_forces(HapticState& state) {
  return {state.node_forces.data(), static_cast<std::size_t>(state.node_force_count)};
}

Vec3 dents_of_others(const HapticState& state, const ToolContact& contact) {
  const PointNodes& at = contact.place.nodes;
  Vec3 u = Vec3::Zero();
  for (const NodeForce& entry : state.forces()) {
    if (entry.tool == contact.tool || entry.body != contact.body) continue;
    for (int v = 0; v < at.count; ++v) {
      if (at.node[v] == entry.node) u += at.weight[v] * entry.dent;
    }
  }
  return u;
}

}  // namespace

void look_for_other_tools(const Region& path, std::int32_t tool, HapticState& state,
                          Bodies& bodies) noexcept {
  ToolState& here = state.tools[tool];
  here.near_others = false;
  here.others_m = 0;
  for (const NodeForce& entry : state.forces()) {
    if (entry.tool == tool) continue;
    Body& body = bodies[entry.body];
    const Vec3& p = body.position(entry.node);
    const double way_m = (p.cwiseMax(path.low).cwiseMin(path.high) - p).norm();
    const double reach_m = body.longest_edge(entry.node);
    here.near_others |= way_m < reach_m + kSoon_m;
    if (way_m < reach_m) here.others_m += (1 - way_m / reach_m) * entry.dent.norm();
  }
  here.others_m = std::min(here.others_m, kMostOthers_m);
}

bool any_near_others(const HapticState& state) noexcept {
  return std::ranges::any_of(state.tools,
                             [](const ToolState& tool) { return tool.engaged && tool.near_others; });
}

void measure_other_tools(BodyId id, Body& body, HapticState& state) noexcept {
  const bool near = any_near_others(state);
  ContactNodes& nodes = body.contact_nodes();
  for (NodeForce& entry : node_forces(state)) {
    if (near && entry.body == id) entry.dent = nodes.own_compliance(nodes.slot_of(entry.node)) * entry.force;
  }
  for (ToolContact& contact : state.active()) {
    if (contact.body == id) contact.other_dents = near ? dents_of_others(state, contact) : Vec3::Zero();
  }
}

}  // namespace omentum::haptic
