// What of an unchecked mesh hangs on a node or an edge only.
#pragma once

#include "geometry/mesh_topology.h"

namespace omentum::geometry {

/// Tetrahedra, ascending, without which the others are manifold as ManifoldRepair says: first parts that
/// share nodes or edges, but no face, with a part of more tetrahedra; then what that class names; then what
/// comes loose by it. Parts that share no node stay, and so does everything in a mesh with faces of more than
/// two tetrahedra, which is another mistake. Precondition: node numbers below `node_count`, four of each.
Offenders hanging_tetrahedra(RawTetrahedra tetrahedra, std::size_t node_count);

}  // namespace omentum::geometry
