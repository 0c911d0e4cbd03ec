// What both VTK formats hold: cells as runs of a node list.
#pragma once

#include "geometry/tetra_mesh.h"

namespace omentum::geometry {

/// Cells of any kind: cell c has the nodes [start[c], start[c+1]) of `nodes` and VTK's type types[c].
struct VtkCells {
  std::vector<std::int64_t> start;  // [cells + 1], or empty when there is none
  std::vector<std::int64_t> nodes;
  std::vector<std::int64_t> types;   // [cells]
  std::vector<std::int32_t> labels;  // [cells], or empty
};

/// Appends the corners of the tetrahedra (type 10; 24 and others of higher order) to `mesh`, whose positions
/// from `first_node` on the cells count, and counts what else there is. The cells are numbered from
/// `first_cell` on, as all of a file are, of whatever kind. Throws InputError naming the cell when its nodes
/// do not exist or are not as many as its type has.
void append_tetrahedra(const VtkCells& cells, std::size_t first_node, std::size_t first_cell, RawMesh& mesh);

}  // namespace omentum::geometry
