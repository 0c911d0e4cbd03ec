// The books of a mesh that is cut: what is left of it, its surface, its pieces.
#pragma once

#include "geometry/covered_faces.h"
#include "geometry/cut_surface.h"
#include "geometry/loose_pieces.h"
#include "geometry/manifold_repair.h"
#include "geometry/remaining_tetrahedra.h"
#include "geometry/tetra_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::geometry {

struct EditorOptions {
  /// What a removal leaves smaller than this, in one piece, is dropped, m^3; 0: nothing is.
  double smallest_piece_m3 = 0;
  /// Nodes of the uncut surface in the order that they are to have: an organ file's (Surface::node); read by
  /// the constructor alone. Empty: that of extract_surface(mesh, {}).
  std::span<const NodeId> uncut_surface{};
  /// [T], other than 0 for tetrahedra that only go when they are asked for: never to repair the mesh, nor in
  /// a small piece. Empty: none. Precondition: they are manifold by themselves.
  std::span<const std::uint8_t> kept{};
  /// Faces of the boundary that are none of the surface as long as what covers them is there; read by the
  /// constructor alone. Then they are bared ones.
  std::span<const CoveredFace> covered{};
};

/// What one removal took, valid until the next change. Each tetrahedron stands in one of the three.
struct Removal {
  std::span<const TetId> asked;     // asked for, and there
  std::span<const TetId> repaired;  // then hung on one node or edge, or parted two hollows there
  std::span<const TetId> dropped;   // of pieces below the smallest size
};

/// Removes tetrahedra of a mesh and keeps, change by change, its boundary, the use of its nodes and its
/// pieces (Cotin 1998, 5.5). After each remove() every boundary edge has two faces, and the tetrahedra and
/// the boundary faces around every node form one fan each, as check_mesh demands of a mesh. Mesh and set of
/// removed tetrahedra alone determine every answer but the order of faces(), so that processes which agree in
/// the set agree in the surface. All memory is taken at construction (about 250 bytes per tetrahedron). One
/// thread at a time.
class MeshEditor {
 public:
  /// `mesh` outlives it. Precondition: mesh was checked; `uncut_surface` is empty or holds every node of its
  /// surface once.
  explicit MeshEditor(const TetraMesh& mesh, const EditorOptions& options = {});
  MeshEditor(const MeshEditor&) = delete;  // its books refer to each other
  MeshEditor& operator=(const MeshEditor&) = delete;

  /// Those that are gone, repeated or out of range are ignored. A few microseconds each, O(surface nodes) at
  /// worst for the surface's order, O(T) where a piece comes off that is as large as the rest.
  Removal remove(std::span<const TetId> tetrahedra) noexcept;

  /// Exactly this set is removed, without repair: what the editor of another process arrived at. Bits beyond
  /// the mesh are ignored, missing ones are zero. What changes costs as in remove(); where something comes
  /// back the pieces are counted anew, O(T).
  void set_removed(std::span<const std::uint8_t> bits) noexcept;

  /// The uncut mesh.
  void restore() noexcept { set_removed({}); }

  /// Precondition: of the mesh.
  bool is_removed(TetId t) const noexcept { return !left_.has(t); }
  std::int32_t removed_count() const noexcept { return left_.removed_count(); }
  /// Bit t % 8 of byte t / 8: tetrahedron t is removed; [(T + 7) / 8].
  std::span<const std::uint8_t> removed_bits() const noexcept { return left_.removed_bits(); }

  /// Tetrahedra left around a node.
  std::int32_t uses(NodeId n) const noexcept { return left_.uses(n); }

  /// Nodes of the surface: first all of the uncut one, in its order, used or not; then, ascending, the others
  /// that lie on a bared face (idl/organ.idl, Topology).
  std::span<const NodeId> surface_nodes() const noexcept { return surface_.nodes(); }
  /// Place in surface_nodes(); invalid: not of the surface.
  SurfaceId surface_of(NodeId n) const noexcept { return surface_.surface_of(n); }
  /// All boundary faces, in any order.
  std::span<const SurfaceFace> faces() const noexcept { return surface_.faces(); }

  /// Parts that no face connects; 0: nothing is left.
  std::int32_t piece_count() const noexcept { return pieces_.count(); }
  /// Which piece a tetrahedron that is left belongs to: equal within a piece, else different, below T.
  /// Changes with every change of the mesh.
  std::int32_t piece_of(TetId t) const noexcept { return pieces_.piece_of(t); }

 private:
  /// The face opposite to a corner, which no tetrahedron of the mesh is across.
  void open_outer(TetId t, int corner) noexcept;
  void close_outer(TetId t, int corner) noexcept;
  void take(TetId t) noexcept;
  void put_back(TetId t) noexcept;
  void remove_one(TetId t) noexcept;
  void repair() noexcept;
  void drop_small_pieces() noexcept;

  TetraLinks links_;
  RemainingTetrahedra left_;
  CutSurface surface_;
  CoveredFaces covered_;
  ManifoldRepair repair_;
  LoosePieces pieces_;
  double smallest_piece_m3_;
  std::vector<TetId> gone_;  // by the last removal, capacity T
};

}  // namespace omentum::geometry
