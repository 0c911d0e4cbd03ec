// The mesh of the tetrahedra that are kept, without the nodes that none of them uses.
#pragma once

#include "geometry/mesh_topology.h"
#include "geometry/tetra_mesh.h"

#include <span>

namespace omentum::geometry {

/// `positions`: of all nodes of the file, m; `tetrahedra`: those that are kept, by the file's nodes; `kept`:
/// their places in the file, ascending. Numbers and labels are those of `raw`; nothing is merged.
TetraMesh compact_mesh(const RawMesh& raw, std::span<const Vec3> positions, RawTetrahedra tetrahedra,
                       std::span<const std::size_t> kept);

}  // namespace omentum::geometry
