// A mesh in two parts: one is precomputed, the other one moves and is cut (Cotin 1998, section 6.2).
#pragma once

#include "geometry/tetra_mesh.h"
#include "physics/supports.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::physics {

/// Some tetrahedra of a mesh, as a mesh of their own with the regions of the whole. Nodes and tetrahedra
/// keep their order.
struct MeshPart {
  geometry::TetraMesh mesh;
  std::vector<geometry::NodeId> node;            // [n] each one's place in the whole, ascending
  std::vector<geometry::TetId> tetrahedron;      // [t] likewise
  std::vector<geometry::NodeId> own_node;        // [N] inverse of `node`; invalid where one is none of it
  std::vector<geometry::TetId> own_tetrahedron;  // [T] likewise
};

/// Connection nodes belong to tetrahedra of both parts.
struct MeshSplit {
  MeshPart precomputed, dynamic;
  std::vector<geometry::NodeId> connection;  // in the whole, ascending
};

/// `dynamic`: [T], other than 0 for tetrahedra of the dynamic part.
MeshSplit split_mesh(const geometry::TetraMesh& whole, std::span<const std::uint8_t> dynamic);

/// The supports of a part's nodes, [n].
FixedComponents supports_of(const MeshPart& part, const FixedComponents& whole);

}  // namespace omentum::physics
