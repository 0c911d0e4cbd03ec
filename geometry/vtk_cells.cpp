#include "geometry/vtk_cells.h"

namespace omentum::geometry {
namespace {

constexpr std::int64_t kTetrahedronCell = 10;

}  // namespace

void append_tetrahedra(const VtkCells& cells, std::size_t first_node, RawMesh& mesh) {
  const auto node_count = static_cast<std::int64_t>(mesh.positions.size() - first_node);
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    if (cells.types[c] != kTetrahedronCell) continue;
    const std::string name =
        "tetrahedron " + std::to_string(mesh.tetrahedra.size()) + " (cell " + std::to_string(c) + ")";
    if (cells.start[c] < 0 || cells.start[c + 1] - cells.start[c] != 4 ||
        cells.start[c + 1] > std::ssize(cells.nodes)) {
      throw InputError(mesh.source + ": " + name + " has not four nodes");
    }
    std::array<std::int32_t, 4> tetrahedron{};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int64_t node = cells.nodes[static_cast<std::size_t>(cells.start[c]) + i];
      if (node < 0 || node >= node_count) {
        throw InputError(mesh.source + ": " + name + " names node " + std::to_string(node) +
                         ", expected 0 to " + std::to_string(node_count - 1));
      }
      tetrahedron[i] = static_cast<std::int32_t>(static_cast<std::int64_t>(first_node) + node);
    }
    mesh.tetrahedra.push_back(tetrahedron);
  }
}

}  // namespace omentum::geometry
