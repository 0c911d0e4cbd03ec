// Which parts of a body that is cut would float away.
#pragma once

#include "geometry/mesh_editor.h"
#include "physics/supports.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// Finds the pieces that supports do not keep from moving as rigid bodies: by topology and the supports'
/// places alone, before anything is solved. Takes its memory when it is made; one thread at a time.
class UnheldPieces {
 public:
  /// `mesh` outlives it.
  UnheldPieces(const geometry::TetraMesh& mesh, FixedComponents fixed);

  /// All tetrahedra of such pieces, those of a piece one after the other; valid until the next call. O(T).
  std::span<const geometry::TetId> find(const geometry::MeshEditor& editor) noexcept;

 private:
  void sort(const geometry::MeshEditor& editor) noexcept;
  bool is_held(std::span<const geometry::TetId> piece) noexcept;

  const geometry::TetraMesh& mesh_;
  FixedComponents fixed_;
  std::vector<std::int32_t> start_;      // [T + 2] of each piece in sorted_
  std::vector<geometry::TetId> sorted_;  // by their pieces, capacity T
  std::vector<geometry::NodeId> nodes_;  // of a piece, each once, capacity N
  std::vector<bool> is_listed_;          // [N] in nodes_
  std::vector<geometry::TetId> found_;   // capacity T
};

}  // namespace omentum::physics
