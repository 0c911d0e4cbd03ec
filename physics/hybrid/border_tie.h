// What holds the two parts of a hybrid organ together where they share no nodes (Cotin 1998, fig. 4b).
#pragma once

#include "physics/hybrid/interface_map.h"
#include "physics/hybrid/mesh_split.h"

namespace omentum::physics {

/// Faces of the precomputed part lie on the dynamic one, and follow it: u_s = sum_m P_sm u_m, s the nodes of
/// those faces, m nodes of the dynamic part.
struct BorderTie {
  std::vector<geometry::TriangleId> faces;  // of the precomputed part's surface, ascending
  std::vector<geometry::SurfaceId> slaves;  // [s] of it, ascending
  InterfaceMap map;                         // masters: in the dynamic part's own numbers
};

/// Ties faces of `surface`, which is the precomputed part's, to the dynamic part by a mortar
/// (interface_map.h). `boundary`: of the dynamic part. Precondition: there is a face.
BorderTie tie_border(const MeshSplit& split, const geometry::Surface& surface,
                     const geometry::Surface& boundary, std::vector<geometry::TriangleId> faces);

}  // namespace omentum::physics
