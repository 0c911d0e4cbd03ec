#include "render_node/node_forces.h"

#include "node_common/vectors.h"
#include "render_node/plausible.h"

#include <algorithm>

namespace omentum::render {

void forces_on(std::size_t organ, std::span<const std::uint32_t> tools, std::int64_t oldest_ns,
               double max_force_n, Inbox& inbox, std::vector<NodeForce>& forces) {
  forces.clear();
  for (const std::uint32_t tool : tools) {
    const auto& [contact, arrived_ns] = inbox.contact(organ, tool);
    if (arrived_ns < oldest_ns || !is_plausible(contact, max_force_n)) continue;
    for (std::size_t i = 0; i < std::min(contact.nodes.size(), contact.forces.size()); ++i)
      forces.push_back({contact.nodes[i], node::to_vector(contact.forces[i]).cast<float>()});
  }
}

}  // namespace omentum::render
