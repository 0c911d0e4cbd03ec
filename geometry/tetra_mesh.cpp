#include "geometry/tetra_mesh.h"

namespace omentum::geometry {

std::vector<NodeId> TetraMesh::nodes_of_file() const {
  std::vector<NodeId> node(static_cast<std::size_t>(file_node_count));
  for (std::size_t n = 0; n < file_node.size(); ++n) node[static_cast<std::size_t>(file_node[n])] = NodeId(n);
  for (const auto& [dropped, kept] : merged)
    node[static_cast<std::size_t>(dropped)] = node[static_cast<std::size_t>(kept)];
  return node;
}

}  // namespace omentum::geometry
