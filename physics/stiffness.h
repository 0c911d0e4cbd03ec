// The assembled stiffness of a mesh, as blocks per pair of neighbouring nodes.
#pragma once

#include "physics/element_tensors.h"
#include "physics/material_map.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// K [3N x 3N] over all nodes, positive semi-definite, N/m: 3x3 blocks in compressed rows. Row n holds its
/// neighbours in ascending order, n itself included.
struct Stiffness {
  std::vector<std::int32_t> start;     // [N+1] into `neighbour` and `block`
  std::vector<NodeId> neighbour;       // [B]
  std::vector<Eigen::Matrix3d> block;  // [B] K_{n, neighbour}

  std::int32_t node_count() const { return static_cast<std::int32_t>(start.size()) - 1; }
};

/// What ties some nodes of a mesh together beside its tetrahedra, such as a part of the organ that was
/// condensed onto them.
struct AddedStiffness {
  std::vector<NodeId> nodes;  // [n], all different; none: nothing
  Eigen::MatrixXd K;          // [3n x 3n], N/m, symmetric, positive semi-definite; x y z of each
};

/// K with blocks for every pair of the added nodes.
Stiffness with_added(const Stiffness& stiffness, const AddedStiffness& added);

/// The sum of the element tensors (Cotin 1998, eq. 6 without its sign: K u is the force that holds u), each
/// of its own tetrahedron's material.
Stiffness assemble_stiffness(const geometry::TetraMesh& mesh, const MaterialMap& material);

/// f = K u, [N], N.
std::vector<Vec3> holding_forces(const Stiffness& stiffness, std::span<const Vec3> displacements);

/// Forces of a uniform acceleration (gravity), lumped consistently for linear elements: a quarter of each
/// tetrahedron's mass times `acceleration` (m/s^2) at each of its corners, [N], N.
std::vector<Vec3> body_forces(const geometry::TetraMesh& mesh, const MaterialMap& material,
                              const Vec3& acceleration);

}  // namespace omentum::physics
