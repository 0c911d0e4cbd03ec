#include "haptic_node/contact_message.h"

#include "node_common/vectors.h"

namespace omentum::haptic {

using node::to_message;

msg::Contact make_contact_message(std::uint32_t tool_id, std::uint32_t organ) {
  msg::Contact message{};
  message.tool = tool_id;
  message.organ = organ;
  message.nodes.reserve(msg::MAX_CONTACT_NODES);
  message.displacements.reserve(msg::MAX_CONTACT_NODES);
  message.forces.reserve(msg::MAX_CONTACT_NODES);
  return message;
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
    if (origin.organ != message.organ || origin.file_node.empty()) continue;
    message.topology_version = origin.topology_version;
    message.nodes.push_back(origin.file_node[static_cast<std::size_t>(entry.node)]);
    message.displacements.push_back(to_message(contact_displacement(entry.body, entry.node, state, bodies)));
    message.forces.push_back(to_message(entry.force));
  }
  message.grasping = output.grasping;
  message.grasp_count = output.grasp_count;
}

}  // namespace omentum::haptic
