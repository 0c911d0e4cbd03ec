// Where two meshes lie on each other without sharing nodes.
#pragma once

#include "geometry/surface.h"

namespace omentum::geometry {

/// A mesh and its boundary; both outlive this.
struct BoundedMesh {
  const TetraMesh& mesh;
  const Surface& surface;
};

/// Triangles of one boundary that lie on another: their corners and centre are within `tolerance_m` of it,
/// and what is nearest to the centre looks the other way. Ascending.
std::vector<TriangleId> faces_on(const BoundedMesh& of, const BoundedMesh& on, double tolerance_m);

/// For points spread over each of these triangles: the tetrahedra of the other mesh behind the nearest
/// boundary faces, each once, ascending.
std::vector<std::vector<TetId>> behind_of(const BoundedMesh& of, std::span<const TriangleId> triangles,
                                          const BoundedMesh& on);

/// How far the deepest boundary node of `of` is inside the other mesh, m; 0: none is.
double deepest_inside(const BoundedMesh& of, const BoundedMesh& in);

}  // namespace omentum::geometry
