#include "deform_node/parted_tissue.h"

#include <algorithm>
#include <utility>

namespace omentum::deform {

using geometry::NodeId;
using geometry::TetId;

PartedTissue::PartedTissue(const geometry::TetraMesh& mesh, const physics::FixedComponents& fixed)
    : mesh_(mesh), unheld_(mesh, fixed), is_let_go_(mesh.tetrahedra.size()) {
  found_.reserve(mesh.tetrahedra.size());
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
  found_.clear();
  std::ranges::copy_if(unheld_.find(editor), std::back_inserter(found_),
                       [&](TetId t) { return !is_let_go_[t]; });
  return found_;
}

void PartedTissue::let_go(std::span<const TetId> tetrahedra, std::span<double> v) noexcept {
  for (const TetId t : tetrahedra) {
    is_let_go_[t] = true;
    for (const NodeId n : mesh_.tetrahedra[t]) geometry::Vec3::Map(&v[3 * n]).setZero();
  }
  any_ = any_ || !tetrahedra.empty();
}

void PartedTissue::restore() noexcept {
  any_ = false;
  std::fill(is_let_go_.begin(), is_let_go_.end(), false);
}

}  // namespace omentum::deform
