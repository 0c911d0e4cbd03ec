// How the tetrahedra of an unchecked mesh hang together, and what is wrong with it.
#pragma once

#include "geometry/types.h"

#include <span>
#include <vector>

namespace omentum::geometry {

/// Tetrahedra as they are read: nodes by number, each positively oriented by the caller.
using RawTetrahedra = std::span<const std::array<std::int32_t, 4>>;

/// Numbers of tetrahedra or nodes that share a fault; may name one several times, in any order.
using Offenders = std::vector<std::size_t>;

/// One side of a face: its nodes in ascending order, where it lies, and whether that order is an even
/// permutation of its outward one.
struct FaceSide {
  std::array<std::int32_t, 3> nodes;
  std::size_t tetrahedron;
  bool even;
};

/// All 4 T sides, those of one face next to each other. O(T log T).
std::vector<FaceSide> collect_face_sides(RawTetrahedra tetrahedra);

/// What neighbours through faces do to each other.
struct FaceFaults {
  Offenders crowded;     // share a face with more than one other
  Offenders inside_out;  // lie on the same side as their neighbour behind most of their faces
  Offenders folded;      // the other pairs that lie on the same side of their face
};
FaceFaults find_face_faults(const std::vector<FaceSide>& sides, std::size_t tetrahedron_count);

/// One tetrahedron of each part that is connected through faces: more than one where the mesh falls apart.
Offenders separate_parts(const std::vector<FaceSide>& sides, std::size_t tetrahedron_count);

/// Tetrahedra behind boundary edges that do not have exactly two boundary faces.
Offenders touching_along_edges(const std::vector<FaceSide>& sides);

/// Nodes whose tetrahedra are not all connected through faces that hold the node: two regions touch there.
Offenders pinched_nodes(const std::vector<FaceSide>& sides, RawTetrahedra tetrahedra, std::size_t node_count);

/// Nodes whose boundary faces do not form one fan, although their tetrahedra are connected: two hollows touch
/// there.
Offenders pinched_boundary_nodes(const std::vector<FaceSide>& sides, std::size_t node_count);

/// Tetrahedra around edges whose dihedral angles add up to more than a full turn: they overlap, although each
/// pair of neighbours looks right.
Offenders winding_around_edges(std::span<const Vec3> positions, RawTetrahedra tetrahedra);

/// Tetrahedra whose boundary faces pass through each other. Where all the faults above are absent, tetrahedra
/// can overlap only so, or where faces of both parts lie in one place.
Offenders crossing_at_boundary(std::span<const Vec3> positions, const std::vector<FaceSide>& sides);

/// Tetrahedra at the boundary whose centre lies inside another one: what overlaps face upon face, without a
/// crossing.
Offenders covered_at_boundary(std::span<const Vec3> positions, RawTetrahedra tetrahedra,
                              const std::vector<FaceSide>& sides);

}  // namespace omentum::geometry
