#include "haptic_node/contact_message.h"

#include "node/vectors.h"

namespace omentum::haptic {

using node::to_message;

msg::Contact make_contact_message(std::uint32_t tool_id) {
  msg::Contact message{};
  message.tool = tool_id;
  message.nodes.reserve(msg::MAX_CONTACT_NODES);
  message.displacements.reserve(msg::MAX_CONTACT_NODES);
  message.forces.reserve(msg::MAX_CONTACT_NODES);
  return message;
}

void fill_contact_message(const HapticModel& model, std::int32_t tool, const ToolOutput& output,
                          const HapticState& state, HapticWorkspace& work, msg::Contact& message) noexcept {
  static_assert(msg::MAX_CONTACT_NODES >= DeformedSurface::kMaxForces);
  message.nodes.clear();
  message.displacements.clear();
  message.forces.clear();
  for (const NodeForce& entry : state.forces()) {
    if (entry.tool != tool) continue;
    message.nodes.push_back(model.file_node[entry.node]);
    message.displacements.push_back(to_message(contact_displacement(entry.node, state, work)));
    message.forces.push_back(to_message(entry.force));
  }
  message.grasping = output.grasping;
  message.grasp_count = output.grasp_count;
}

}  // namespace omentum::haptic
