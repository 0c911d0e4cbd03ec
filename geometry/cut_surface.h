// The boundary of what is left of a mesh, kept face by face.
#pragma once

#include "geometry/tetra_links.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace omentum::geometry {

/// A face of one tetrahedron that is left.
struct SurfaceFace {
  std::array<NodeId, 3> nodes;  // counter-clockwise seen from outside
  TetId behind;
  bool bared = false;  // by a removal; else it lies on the surface of the uncut mesh
};

/// Faces and nodes of the boundary. Its order of nodes depends on the faces alone, not on how they came
/// about: first those of the uncut surface, which keep their places whatever happens; then, ascending, the
/// others that a face holds. Takes its memory when it is made. `links` outlives it.
class CutSurface {
 public:
  /// `uncut`: the nodes of the uncut surface, in their order.
  CutSurface(const TetraLinks& links, std::span<const NodeId> uncut);

  /// The face opposite to a corner of a tetrahedron begins to be, or ends being, one of the boundary;
  /// settle() after all changes. Preconditions: it was not, or was. `bared`: though no tetrahedron of the
  /// mesh was across it.
  void open(TetId t, int corner, bool bared = false) noexcept;
  void close(TetId t, int corner) noexcept;
  void settle() noexcept;

  std::span<const SurfaceFace> faces() const noexcept { return faces_; }
  std::span<const NodeId> nodes() const noexcept { return nodes_; }

  /// Place in nodes(); invalid: not one of them. O(log S) for nodes that a cut bared.
  SurfaceId surface_of(NodeId n) const noexcept;

 private:
  std::vector<NodeId>::iterator place_of(NodeId n) noexcept;
  void count(const SurfaceFace& face, std::int32_t change) noexcept;

  const TetraLinks& links_;
  std::size_t uncut_count_;
  std::vector<SurfaceId> uncut_place_;           // [N]; invalid: not of the uncut surface
  std::vector<SurfaceFace> faces_;               // [F now], capacity for all faces of the mesh
  std::vector<std::array<std::int32_t, 4>> at_;  // [T], where each face opposite a corner is in faces_; -1
  std::vector<std::int32_t> face_count_;         // [N], of faces_
  std::vector<NodeId> nodes_;                    // capacity N
  std::vector<NodeId> unsettled_;                // inner nodes whose face count changed, each once
  std::vector<bool> is_unsettled_;               // [N]
};

}  // namespace omentum::geometry
