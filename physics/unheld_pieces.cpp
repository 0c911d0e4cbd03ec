#include "physics/unheld_pieces.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace omentum::physics {

using geometry::MeshEditor;
using geometry::NodeId;
using geometry::TetId;

UnheldPieces::UnheldPieces(const geometry::TetraMesh& mesh, FixedComponents fixed)
    : mesh_(mesh),
      fixed_(std::move(fixed)),
      start_(mesh.tetrahedra.size() + 2),
      is_listed_(mesh.positions.size()) {
  sorted_.reserve(mesh.tetrahedra.size());
  nodes_.reserve(mesh.positions.size());
  found_.reserve(mesh.tetrahedra.size());
}

// By counting: start_[p + 1] is where piece p begins, until each was put in, and where it ends afterwards.
void UnheldPieces::sort(const MeshEditor& editor) noexcept {
  std::ranges::fill(start_, 0);
  const std::size_t count = mesh_.tetrahedra.size();
  for (std::size_t t = 0; t < count; ++t)
    if (!editor.is_removed(TetId(t))) ++start_[static_cast<std::size_t>(editor.piece_of(TetId(t))) + 2];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  sorted_.resize(static_cast<std::size_t>(start_.back()));
  for (std::size_t t = 0; t < count; ++t) {
    if (editor.is_removed(TetId(t))) continue;
    sorted_[start_[static_cast<std::size_t>(editor.piece_of(TetId(t))) + 1]++] = TetId(t);
  }
}

bool UnheldPieces::is_held(std::span<const TetId> piece) noexcept {
  nodes_.clear();
  for (const TetId t : piece) {
    for (const NodeId n : mesh_.tetrahedra[t]) {
      if (!is_listed_[n]) nodes_.push_back(n);
      is_listed_[n] = true;
    }
  }
  for (const NodeId n : nodes_) is_listed_[n] = false;
  return loose_motions(mesh_, nodes_, fixed_) == 0;
}

std::span<const TetId> UnheldPieces::find(const MeshEditor& editor) noexcept {
  sort(editor);
  found_.clear();
  for (std::size_t p = 0; p + 1 < start_.size(); ++p) {
    const auto piece = std::span<const TetId>(sorted_).subspan(
        static_cast<std::size_t>(start_[p]), static_cast<std::size_t>(start_[p + 1] - start_[p]));
    if (!piece.empty() && !is_held(piece)) found_.insert(found_.end(), piece.begin(), piece.end());
  }
  return found_;
}

}  // namespace omentum::physics
