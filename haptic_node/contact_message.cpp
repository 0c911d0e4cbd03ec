#include "haptic_node/contact_message.h"

#include "node_common/vectors.h"

#include <algorithm>

namespace omentum::haptic {

using node::to_message;

namespace {

bool belongs_to(std::uint32_t organ, const BodyOrigin& origin) noexcept {
  return origin.organ == organ && !origin.file_node.empty();
}

bool holds(std::int32_t tool, std::uint32_t organ, const HapticState& state, Bodies& bodies) noexcept {
  return std::ranges::any_of(state.active(), [&](const ToolContact& contact) {
    return contact.tool == tool && contact.grasped && belongs_to(organ, bodies[contact.body].origin());
  });
}

}  // namespace

msg::Contact make_contact_message(std::uint32_t tool_id, std::uint32_t organ) {
  msg::Contact message{};
  message.tool = tool_id;
  message.organ = organ;
  message.nodes.reserve(msg::MAX_CONTACT_NODES);
  message.displacements.reserve(msg::MAX_CONTACT_NODES);
  message.forces.reserve(msg::MAX_CONTACT_NODES);
  return message;
}

bool touches(std::int32_t tool, std::uint32_t organ, const HapticState& state, Bodies& bodies) noexcept {
  const auto presses = [&](const NodeForce& entry) {
    return entry.tool == tool && belongs_to(organ, bodies[entry.body].origin());
  };
  return std::ranges::any_of(state.forces(), presses) || holds(tool, organ, state, bodies);
}

void fill_contact_message(std::int32_t tool, const ToolOutput& output, const HapticState& state,
                          Bodies& bodies, msg::Contact& message) noexcept {
  static_assert(msg::MAX_CONTACT_NODES >= Body::kMaxForces);
  message.nodes.clear();
  message.displacements.clear();
  message.forces.clear();
  for (const NodeForce& entry : state.forces()) {
    if (entry.tool != tool) continue;
    const BodyOrigin& origin = bodies[entry.body].origin();
    if (!belongs_to(message.organ, origin)) continue;
    message.topology_version = origin.topology_version;
    message.nodes.push_back(origin.file_node[static_cast<std::size_t>(entry.node)]);
    message.displacements.push_back(to_message(contact_displacement(entry.body, entry.node, state, bodies)));
    message.forces.push_back(to_message(entry.force));
  }
  message.grasping = holds(tool, message.organ, state, bodies);
  message.grasp_count = output.grasp_count;
}

}  // namespace omentum::haptic
