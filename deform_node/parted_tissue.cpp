#include "deform_node/parted_tissue.h"

#include <algorithm>

namespace omentum::deform {

using geometry::NodeId;
using geometry::TetId;

PartedTissue::PartedTissue(const geometry::TetraMesh& mesh, const physics::Inertia& inertia)
    : mesh_(mesh), inertia_(inertia), unheld_(mesh, inertia.fixed), is_let_go_(mesh.tetrahedra.size()) {
  found_.reserve(mesh.tetrahedra.size());
}

physics::Inertia PartedTissue::without_motion(physics::Inertia inertia) {
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

void PartedTissue::let_go(std::span<const TetId> tetrahedra, physics::Inertia& inertia,
                          std::span<double> v) noexcept {
  for (const TetId t : tetrahedra) {
    is_let_go_[t] = true;
    for (const NodeId n : mesh_.tetrahedra[t]) {
      inertia.mass[n] = inertia_.mass[n];
      inertia.fixed[n] = 0;
      geometry::Vec3::Map(&v[3 * n]).setZero();
    }
  }
  any_ = any_ || !tetrahedra.empty();
}

void PartedTissue::restore(physics::Inertia& inertia) noexcept {
  if (!any_) return;
  any_ = false;
  std::fill(is_let_go_.begin(), is_let_go_.end(), false);
  std::ranges::fill(inertia.mass, 0.0);
  std::ranges::fill(inertia.fixed, physics::kPinned);
}

}  // namespace omentum::deform
