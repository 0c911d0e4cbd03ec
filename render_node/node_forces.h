// Which forces tools put on an organ's nodes now, as they came over the wire.
#pragma once

#include "render_node/contact_pressure.h"
#include "render_node/inbox.h"

namespace omentum::render {

/// Of all these tools on one organ. Contacts older than `oldest_ns` (the inbox's clock) are over, and so are
/// those that no scene with hands of at most `max_force_n` can have. The drawing thread.
void forces_on(std::size_t organ, std::span<const std::uint32_t> tools, std::int64_t oldest_ns,
               double max_force_n, Inbox& inbox, std::vector<NodeForce>& forces);

}  // namespace omentum::render
