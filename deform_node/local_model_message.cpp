#include "deform_node/local_model_message.h"

#include "node_common/vectors.h"

namespace omentum::deform {

void fill_local_model(const StampedPatch& stamped, msg::LocalModel& message) {
  const LocalPatch& patch = stamped.patch;
  const auto nodes = static_cast<std::ptrdiff_t>(patch.node_count), rows = 3 * nodes;
  message.organ = stamped.organ;
  message.patch = stamped.tool;
  message.seq = stamped.seq;
  message.stamp_ns = stamped.stamp_ns;
  message.topology_version = patch.topology_version;
  message.echoes.assign(stamped.echoes.all().begin(), stamped.echoes.all().end());
  message.nodes.assign(patch.nodes.begin(), patch.nodes.begin() + nodes);
  const auto take = [&](const std::vector<Vec3>& from, auto& to) {
    to.clear();
    for (std::ptrdiff_t n = 0; n < nodes; ++n)
      to.push_back(node::to_message(from[static_cast<std::size_t>(n)]));
  };
  take(patch.positions, message.positions);
  take(patch.velocities, message.velocities);
  take(patch.forces, message.forces);
  message.triangles.clear();
  for (std::size_t t = 0; t < patch.triangle_count; ++t)
    message.triangles.insert(message.triangles.end(), patch.triangles[t].begin(), patch.triangles[t].end());
  message.compliance.assign(patch.compliance.begin(), patch.compliance.begin() + rows * (rows + 1) / 2);
}

}  // namespace omentum::deform
