#include "geometry/mesh_editor.h"

#include "geometry/surface.h"

#include <bit>
#include <limits>

namespace omentum::geometry {
namespace {

std::vector<NodeId> uncut_nodes(const TetraMesh& mesh, std::span<const NodeId> chosen) {
  return chosen.empty() ? extract_surface(mesh, {}).node : std::vector<NodeId>(chosen.begin(), chosen.end());
}

// What is kept makes every piece that holds it large enough.
std::vector<double> volumes(const TetraMesh& mesh, std::span<const std::uint8_t> kept) {
  std::vector<double> volume_m3;
  volume_m3.reserve(mesh.tetrahedra.size());
  const auto at = [&](NodeId n) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(n)]; };
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    volume_m3.push_back(signed_volume(at(a), at(b), at(c), at(d)));
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t] != 0) volume_m3[t] = std::numeric_limits<double>::infinity();
  return volume_m3;
}

}  // namespace

MeshEditor::MeshEditor(const TetraMesh& mesh, const EditorOptions& options)
    : links_(mesh.tetrahedra, mesh.positions.size()),
      left_(links_),
      surface_(links_, uncut_nodes(mesh, options.uncut_surface)),
      covered_(options.covered, mesh.tetrahedra.size()),
      repair_(left_, options.kept),
      pieces_(left_, volumes(mesh, options.kept)),
      smallest_piece_m3_(options.smallest_piece_m3) {
  gone_.reserve(mesh.tetrahedra.size());
  for (const CoveredFace& face : covered_.faces()) surface_.close(face.behind, face.corner);
}

void MeshEditor::open_outer(TetId t, int corner) noexcept {
  const std::int32_t covered = covered_.place_of(t, corner);
  if (covered < 0 || !covered_.is_hidden(covered)) surface_.open(t, corner, covered >= 0);
}

void MeshEditor::close_outer(TetId t, int corner) noexcept {
  const std::int32_t covered = covered_.place_of(t, corner);
  if (covered < 0 || !covered_.is_hidden(covered)) surface_.close(t, corner);
}

void MeshEditor::take(TetId t) noexcept {
  left_.take(t);
  for (int corner = 0; corner < 4; ++corner) {
    const TetId neighbour = links_.across(t)[static_cast<std::size_t>(corner)];
    if (left_.has_neighbour(neighbour)) {
      surface_.open(neighbour, links_.corner_facing(neighbour, t));
    } else if (neighbour.valid()) {
      surface_.close(t, corner);
    } else {
      close_outer(t, corner);
    }
  }
  for (const std::int32_t f : covered_.covered_by(t)) {
    const CoveredFace& face = covered_.faces()[static_cast<std::size_t>(f)];
    if (covered_.uncover(f) && left_.has(face.behind)) surface_.open(face.behind, face.corner, true);
  }
}

void MeshEditor::put_back(TetId t) noexcept {
  left_.put_back(t);
  for (int corner = 0; corner < 4; ++corner) {
    const TetId neighbour = links_.across(t)[static_cast<std::size_t>(corner)];
    if (left_.has_neighbour(neighbour)) {
      surface_.close(neighbour, links_.corner_facing(neighbour, t));
    } else if (neighbour.valid()) {
      surface_.open(t, corner);
    } else {
      open_outer(t, corner);
    }
  }
  for (const std::int32_t f : covered_.covered_by(t)) {
    const CoveredFace& face = covered_.faces()[static_cast<std::size_t>(f)];
    if (covered_.cover(f) && left_.has(face.behind)) surface_.close(face.behind, face.corner);
  }
}

void MeshEditor::remove_one(TetId t) noexcept {
  take(t);
  pieces_.note_removed(t);
  gone_.push_back(t);
}

Removal MeshEditor::remove(std::span<const TetId> tetrahedra) noexcept {
  gone_.clear();
  for (const TetId t : tetrahedra) {
    if (!t.valid() || t >= links_.tetrahedron_count() || is_removed(t)) continue;
    remove_one(t);
    repair_.note_removed(t);
  }
  const std::size_t asked = gone_.size();
  repair();
  const std::size_t repaired = gone_.size() - asked;
  drop_small_pieces();
  surface_.settle();
  const std::span<const TetId> all = gone_;
  return {all.first(asked), all.subspan(asked, repaired), all.subspan(asked + repaired)};
}

void MeshEditor::repair() noexcept {
  for (auto victims = repair_.next(); !victims.empty(); victims = repair_.next()) {
    for (const TetId t : victims) {
      remove_one(t);
      repair_.note_removed(t);
    }
  }
}

// A piece is whole, so that nothing that stays loses manifoldness with it.
void MeshEditor::drop_small_pieces() noexcept {
  pieces_.find_pieces(gone_);
  for (auto piece = pieces_.smaller_than(smallest_piece_m3_); !piece.empty();
       piece = pieces_.smaller_than(smallest_piece_m3_)) {
    for (const TetId t : piece) remove_one(t);
  }
}

void MeshEditor::set_removed(std::span<const std::uint8_t> bits) noexcept {
  gone_.clear();
  bool anything_back = false;
  for (std::size_t byte = 0; byte < removed_bits().size(); ++byte) {
    const unsigned wanted = byte < bits.size() ? bits[byte] : 0u;
    for (unsigned changes = wanted ^ removed_bits()[byte]; changes != 0; changes &= changes - 1) {
      const TetId t(8 * byte + static_cast<std::size_t>(std::countr_zero(changes)));
      if (t >= links_.tetrahedron_count()) break;
      if (!is_removed(t)) {
        remove_one(t);
      } else {
        put_back(t);
        anything_back = true;
      }
    }
  }
  if (anything_back) {
    pieces_.count_anew();
  } else {
    pieces_.find_pieces(gone_);
  }
  surface_.settle();
}

}  // namespace omentum::geometry
