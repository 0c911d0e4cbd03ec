#include "physics/hybrid/mesh_split.h"

#include "geometry/precondition.h"

namespace omentum::physics {

namespace {

using geometry::NodeId;
using geometry::TetId;
using geometry::TetraMesh;

void take_nodes(const TetraMesh& whole, const std::vector<bool>& used, MeshPart& part) {
  part.own_node.resize(used.size());
  for (std::size_t n = 0; n < used.size(); ++n) {
    if (!used[n]) continue;
    part.own_node[n] = NodeId(part.node.size());
    part.node.emplace_back(n);
    part.mesh.positions.push_back(whole.positions[n]);
  }
}

MeshPart part_of(const TetraMesh& whole, std::span<const std::uint8_t> dynamic, bool is_dynamic) {
  MeshPart part;
  std::vector<bool> used(whole.positions.size());
  part.own_tetrahedron.resize(dynamic.size());
  for (std::size_t t = 0; t < dynamic.size(); ++t) {
    if ((dynamic[t] != 0) != is_dynamic) continue;
    part.own_tetrahedron[t] = TetId(part.tetrahedron.size());
    part.tetrahedron.emplace_back(t);
    for (const NodeId n : whole.tetrahedra[t]) used[n] = true;
  }
  take_nodes(whole, used, part);
  for (const TetId t : part.tetrahedron) {
    geometry::Tetrahedron own = whole.tetrahedra[t];
    for (NodeId& n : own) n = part.own_node[n];
    part.mesh.tetrahedra.push_back(own);
    if (!whole.regions.empty()) part.mesh.regions.push_back(whole.regions[t]);
  }
  return part;
}

}  // namespace

MeshSplit split_mesh(const TetraMesh& whole, std::span<const std::uint8_t> dynamic) {
  geometry::require(dynamic.size() == whole.tetrahedra.size(), "a flag for each tetrahedron");
  MeshSplit split{part_of(whole, dynamic, false), part_of(whole, dynamic, true), {}};
  for (const NodeId n : split.dynamic.node)
    if (split.precomputed.own_node[n].valid()) split.connection.push_back(n);
  return split;
}

FixedComponents supports_of(const MeshPart& part, const FixedComponents& whole) {
  FixedComponents own;
  for (const NodeId n : part.node) own.push_back(whole[n]);
  return own;
}

}  // namespace omentum::physics
