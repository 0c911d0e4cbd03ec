// The boundary of a tetrahedral mesh, numbered in spatial order so that neighbours share cache lines.
#pragma once

#include "geometry/tetra_mesh.h"

#include <span>

namespace omentum::geometry {

/// Surface nodes per cluster: one 64-byte line of floats. A cluster is 16 consecutive SurfaceIds.
inline constexpr int kClusterSize = 16;

/// Boundary triangles and their nodes. Nodes are ordered by recursive median splits into clusters
/// of kClusterSize, so that a cluster is compact in space. Nodes for which `pinned` is true come
/// last (they never move and carry no tensors): SurfaceIds below `mobile_count` are the others.
struct Surface {
  std::vector<NodeId> node;             // [S] mesh node of each surface node
  std::vector<SurfaceId> of_node;       // [N] inverse; invalid for inner nodes
  std::vector<Triangle> triangles;      // [F] outward
  std::vector<TetId> tetrahedron;       // [F] the one behind each triangle
  std::vector<std::int32_t> fan_start;  // [S+1] into `fan`
  std::vector<TriangleId> fan;          // triangles around each node
  std::int32_t mobile_count = 0;

  std::int32_t node_count() const { return static_cast<std::int32_t>(node.size()); }
  std::span<const TriangleId> triangles_of(SurfaceId s) const {
    return {fan.data() + fan_start[s], fan.data() + fan_start[s + 1]};
  }
};

/// `pinned[n]` (may be empty: none) tells which mesh nodes are fixed in all three components.
Surface extract_surface(const TetraMesh& mesh, const std::vector<bool>& pinned);

/// The surface that triangles make, which may be open: numbered as given, `node_count` nodes, all mobile,
/// without a mesh behind it (no `tetrahedron`).
Surface surface_of_triangles(std::int32_t node_count, std::vector<Triangle> triangles);

/// Rest positions of the surface's nodes, [S], m.
std::vector<Vec3> surface_positions(const TetraMesh& mesh, const Surface& surface);

/// Outward unit normals of the surface's nodes, [S]: the mean of their triangles', by area. `positions`: [S].
std::vector<Vec3> surface_normals(const Surface& surface, std::span<const Vec3> positions);

}  // namespace omentum::geometry
