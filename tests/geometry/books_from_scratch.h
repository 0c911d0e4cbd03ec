// The books of a cut mesh made from scratch, by no code that the editor shares.
#pragma once

#include "geometry/mesh_editor.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace omentum::geometry {

/// The nodes of a face turned so that the smallest is first: equal for equal faces seen from the same side.
using Corners = std::array<std::int32_t, 3>;

struct FaceBook {
  std::int32_t behind;
  bool bared;
  auto operator<=>(const FaceBook&) const = default;
};

struct Books {
  std::vector<std::int32_t> uses;
  std::map<Corners, FaceBook> faces;  // by turned nodes, outward
  std::vector<NodeId> surface;
  std::map<std::int32_t, std::int32_t> piece;  // a tetrahedron of the same piece, of each that is left
  std::int32_t pieces = 0;
};

/// Of the tetrahedra `left`. `uncut`: the nodes of the uncut surface, in their order.
Books books_from_scratch(const TetraMesh& mesh, const std::vector<std::int32_t>& left,
                         std::span<const NodeId> uncut);

/// What the editor does not call removed, ascending.
std::vector<std::int32_t> left_of(const MeshEditor& editor, const TetraMesh& mesh);

/// What differs between the editor's books and those made from scratch for what it calls left: uses, faces,
/// surface nodes and their places, pieces, counts; empty: nothing. `uncut`: as the editor was given them.
std::string difference_from_scratch(const MeshEditor& editor, const TetraMesh& mesh,
                                    std::span<const NodeId> uncut);

/// What is not manifold in the rest of the mesh, as check_mesh sees it; empty: nothing.
std::string not_manifold(const MeshEditor& editor, const TetraMesh& mesh);

}  // namespace omentum::geometry
