// A hybrid organ that is made of two meshes, which lie on each other without sharing nodes.
#pragma once

#include "geometry/tetra_mesh.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace omentum::organ {

/// Faces of either part that lie on the other one, by their nodes in the whole, counter-clockwise from
/// outside.
using BorderFaces = std::vector<std::array<geometry::NodeId, 3>>;

/// Two meshes in one: first the precomputed part's nodes and tetrahedra, then the dynamic one's.
struct JoinedParts {
  geometry::TetraMesh mesh;
  std::vector<std::uint8_t> dynamic;  // [T] 1: of the dynamic part
  BorderFaces border;
  // What is added to the numbers that the dynamic part's file gives its nodes and tetrahedra.
  std::int64_t node_shift = 0, tetrahedron_shift = 0;
};

/// Two checked meshes that lie on each other to within `gap_m`; 0: to a twentieth of the mean edge of the
/// dynamic part's boundary. Labels of regions are kept where both have some. Throws geometry::InputError,
/// beginning with `where`, for parts that do not touch or overlap by more than that.
JoinedParts join_parts(const geometry::TetraMesh& precomputed, const geometry::TetraMesh& dynamic,
                       double gap_m, const std::string& where);

}  // namespace omentum::organ
