// What a haptic_node says to a deform_node that serves a block, and what comes of it.
#pragma once

#include "organ/organ.h"
#include "transport/messages.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform_test {

using geometry::Vec3;

/// OrganState holds floats, and so do the tensors.
inline constexpr double kWithin = 1e-3;

/// Pushes four mobile surface nodes, by mesh file number.
inline msg::Contact push(const organ::Organ& organ, std::uint64_t seq) {
  msg::Contact contact{};
  contact.cause = {.tool = 0, .seq = seq, .stamp_ns = 5};
  for (int i = 0; i < 4; ++i) {
    const geometry::SurfaceId s(i * (organ.surface.mobile_count / 4));
    contact.nodes.push_back(static_cast<std::uint32_t>(organ.mesh.file_node[organ.surface.node[s]]));
    contact.forces.push_back({0.1 * i, -0.2, -1.0 + 0.1 * i});
  }
  contact.displacements.resize(contact.nodes.size());
  return contact;
}

/// Of all components, m.
inline double largest(const msg::OrganState& state) {
  double value = 0;
  for (const float u : state.values) value = std::max(value, std::abs(static_cast<double>(u)));
  return value;
}

/// Largest difference from u = C f, node by node, with the organ file's own tensors, m.
inline double difference_from_plain_sum(const organ::Organ& organ, const msg::Contact& contact,
                                        const msg::OrganState& state) {
  const auto of_file_node = organ.surface_of_file_node();
  double worst = 0;
  for (std::int32_t n = 0; n < organ.surface.node_count(); ++n) {
    Vec3 plain = Vec3::Zero();
    for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
      const msg::Vec3& f = contact.forces[i];
      plain += organ.compliance->block(geometry::SurfaceId(n), of_file_node[contact.nodes[i]]) *
               Vec3(f.x, f.y, f.z);
    }
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(plain[c] - state.values[3 * n + c]));
  }
  return worst;
}

}  // namespace omentum::deform_test
