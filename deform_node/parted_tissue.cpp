#include "deform_node/parted_tissue.h"

#include <algorithm>
#include <utility>

namespace omentum::deform {

using geometry::NodeId;
using geometry::TetId;

PartedTissue::PartedTissue(const geometry::TetraMesh& mesh, const physics::FixedComponents& fixed,
                           std::vector<std::uint8_t> massless)
    : mesh_(mesh),
      fixed_(fixed),
      unheld_(mesh, fixed),
      massless_(std::move(massless)),
      is_let_go_(mesh.tetrahedra.size()) {
  found_.reserve(mesh.tetrahedra.size());
  tied_.reserve(mesh.tetrahedra.size());
}

physics::Inertia PartedTissue::met(physics::Inertia inertia, bool fall) {
  if (fall) return without_supports(std::move(inertia));
  std::ranges::fill(inertia.mass, 0.0);
  std::ranges::fill(inertia.fixed, physics::kPinned);
  return inertia;
}

physics::Inertia PartedTissue::without_supports(physics::Inertia inertia) {
  std::ranges::fill(inertia.fixed, std::uint8_t{0});
  return inertia;
}

std::span<const TetId> PartedTissue::find(const geometry::MeshEditor& editor) noexcept {
  const auto needs_mass = [&](TetId t) { return !is_let_go_[t] && (massless_.empty() || massless_[t] != 0); };
  found_.clear();
  for (std::span<const TetId> rest = unheld_.find(editor); !rest.empty();) {
    const auto is_other = [&](TetId t) { return editor.piece_of(t) != editor.piece_of(rest.front()); };
    const auto end = std::ranges::find_if(rest, is_other);
    const std::span<const TetId> piece(rest.begin(), end);
    if (std::ranges::any_of(piece, needs_mass)) found_.insert(found_.end(), piece.begin(), piece.end());
    rest = std::span(end, rest.end());
  }
  return found_;
}

std::span<const TetId> PartedTissue::on_supports(std::span<const TetId> pieces) noexcept {
  tied_.clear();
  std::ranges::copy_if(pieces, std::back_inserter(tied_), [&](TetId t) {
    return std::ranges::any_of(mesh_.tetrahedra[t], [&](NodeId n) { return fixed_[n] != 0; });
  });
  return tied_;
}

void PartedTissue::let_go(std::span<const TetId> tetrahedra, std::span<const double> mass,
                          std::span<double> v) noexcept {
  for (const TetId t : tetrahedra) {
    is_let_go_[t] = true;
    for (const NodeId n : mesh_.tetrahedra[t])
      if (mass[n] == 0) geometry::Vec3::Map(&v[3 * n]).setZero();
  }
  any_ = any_ || !tetrahedra.empty();
}

void PartedTissue::restore() noexcept {
  any_ = false;
  std::fill(is_let_go_.begin(), is_let_go_.end(), false);
}

}  // namespace omentum::deform
