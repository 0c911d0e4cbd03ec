#include "deform_node/local_model_message.h"

#include "node/vectors.h"

#include <algorithm>

namespace omentum::deform {

namespace {

std::vector<Vec3> normals_of(const LocalPatch& patch) {
  std::vector<Vec3> normals(patch.node_count, Vec3::Zero());
  for (std::size_t t = 0; t < patch.triangle_count; ++t) {
    const auto [a, b, c] = patch.triangles[t];
    const Vec3& p = patch.positions[a];
    const Vec3 doubled_area = (patch.positions[b] - p).cross(patch.positions[c] - p);
    for (const auto corner : {a, b, c}) normals[corner] += doubled_area;
  }
  for (Vec3& normal : normals) normal.normalize();
  return normals;
}

// The whole matrix, row by row, from its upper triangle.
void unfold(const std::vector<float>& upper, std::size_t rows, std::vector<float>& whole) {
  whole.resize(rows * rows);
  auto entry = upper.begin();
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = r; c < rows; ++c) whole[r * rows + c] = whole[c * rows + r] = *entry++;
}

}  // namespace

void fill_local_model(const StampedPatch& stamped, msg::LocalModel& message) {
  const LocalPatch& patch = stamped.patch;
  const auto echoes = stamped.echoes.all();
  const auto cause = std::find_if(echoes.begin(), echoes.end(),
                                  [&](const msg::Echo& echo) { return echo.tool == stamped.tool; });
  message.tool = stamped.tool;
  message.organ = stamped.organ;
  message.seq = stamped.seq;
  message.stamp_ns = stamped.stamp_ns;
  message.topology_version = patch.topology_version;
  message.cause = cause != echoes.end() ? *cause : msg::Echo{.tool = stamped.tool, .seq = 0, .stamp_ns = 0};
  message.nodes.assign(patch.nodes.begin(),
                       patch.nodes.begin() + static_cast<std::ptrdiff_t>(patch.node_count));
  message.positions.clear();
  message.normals.clear();
  for (std::size_t n = 0; n < patch.node_count; ++n)
    message.positions.push_back(node::to_message(patch.positions[n]));
  for (const Vec3& normal : normals_of(patch)) message.normals.push_back(node::to_message(normal));
  unfold(patch.compliance, 3 * patch.node_count, message.compliance);
}

}  // namespace omentum::deform
