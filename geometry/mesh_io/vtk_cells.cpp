#include "geometry/mesh_io/vtk_cells.h"

#include <span>

namespace omentum::geometry {
namespace {

constexpr std::int64_t kLinear = 10, kQuadratic = 24;
constexpr std::size_t kCorners = 4;

// Of higher orders (Lagrange, Bezier) the cell itself says how many nodes there are.
bool has_count_of(std::int64_t type, std::size_t nodes) {
  if (type == kLinear) return nodes == kCorners;
  if (type == kQuadratic) return nodes == 10;
  return nodes >= kCorners;
}

// The nodes of a cell; none where its place in the list is not one.
std::span<const std::int64_t> nodes_of(const VtkCells& cells, std::size_t c) {
  const std::int64_t first = cells.start[c], last = cells.start[c + 1];
  if (first < 0 || last < first || last > std::ssize(cells.nodes)) return {};
  return std::span(cells.nodes)
      .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first));
}

}  // namespace

void append_tetrahedra(const VtkCells& cells, std::size_t first_node, std::size_t first_cell, RawMesh& mesh) {
  const auto node_count = static_cast<std::int64_t>(mesh.positions.size() - first_node);
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const ElementKind kind = vtk_kind(cells.types[c]);
    if (kind != ElementKind::kTetrahedron) {
      ++mesh.others[static_cast<std::size_t>(kind)];
      continue;
    }
    const std::string name = "tetrahedron " + std::to_string(first_cell + c);
    const std::span<const std::int64_t> nodes = nodes_of(cells, c);
    if (!has_count_of(cells.types[c], nodes.size())) {
      throw InputError(mesh.source + ": " + name + " has not the nodes of a cell of type " +
                       std::to_string(cells.types[c]));
    }
    std::array<std::int32_t, kCorners> tetrahedron{};
    for (std::size_t i = 0; i < kCorners; ++i) {
      if (nodes[i] < 0 || nodes[i] >= node_count) {
        throw InputError(mesh.source + ": " + name + " names node " + std::to_string(nodes[i]) +
                         ", expected 0 to " + std::to_string(node_count - 1));
      }
      tetrahedron[i] = static_cast<std::int32_t>(static_cast<std::int64_t>(first_node) + nodes[i]);
    }
    mesh.tetrahedra.push_back(tetrahedron);
    mesh.tetrahedron_numbers.push_back(static_cast<std::int64_t>(first_cell + c));
    mesh.regions.push_back(cells.labels.empty() ? 0 : cells.labels[c]);
    if (nodes.size() > kCorners) ++mesh.curved;
  }
}

}  // namespace omentum::geometry
