#include "physics/dynamics/linear_tissue.h"

#include <algorithm>

namespace omentum::physics {

using geometry::NodeId;
using geometry::TetId;

namespace {

// All nodes, and the chosen tetrahedra.
geometry::TetraMesh part_of(const geometry::TetraMesh& mesh, std::span<const std::uint8_t> chosen) {
  geometry::TetraMesh part;
  if (std::ranges::all_of(chosen, [](std::uint8_t is) { return is == 0; })) return part;
  part.positions = mesh.positions;
  for (std::size_t t = 0; t < chosen.size(); ++t) {
    if (chosen[t] == 0) continue;
    part.tetrahedra.push_back(mesh.tetrahedra[t]);
    if (!mesh.regions.empty()) part.regions.push_back(mesh.regions[t]);
  }
  return part;
}

}  // namespace

LinearTissue::LinearTissue(const geometry::TetraMesh& mesh, const MaterialMap& material,
                           std::span<const std::uint8_t> chosen)
    : mesh_(mesh), material_(material), stiffness_(assemble_stiffness(part_of(mesh, chosen), material)) {
  if (stiffness_.block.empty()) return;
  chosen_.assign(chosen.begin(), chosen.end());
  has_ = chosen_;
  uncut_ = stiffness_.block;
  ties_.resize(mesh.positions.size());
  f_.resize(3 * mesh.positions.size());
  count_ties();
}

void LinearTissue::count_ties() noexcept {
  std::ranges::fill(ties_, 0);
  for (std::size_t t = 0; t < has_.size(); ++t)
    if (has_[t] != 0)
      for (const NodeId n : mesh_.tetrahedra[t]) ++ties_[n];
}

void LinearTissue::add_product(double scale, std::span<const double> u, std::span<double> f) noexcept {
  for (std::int32_t n = 0; n < stiffness_.node_count(); ++n) {
    if (ties_[n] == 0) continue;
    Vec3 sum = Vec3::Zero();
    for (std::int32_t b = stiffness_.start[n]; b < stiffness_.start[n + 1]; ++b)
      sum += stiffness_.block[b] * Eigen::Map<const Vec3>(u.data() + 3 * stiffness_.neighbour[b]);
    Vec3::Map(f.data() + 3 * static_cast<std::size_t>(n)) += scale * sum;
  }
}

double LinearTissue::energy(std::span<const double> u) noexcept {
  std::ranges::fill(f_, 0.0);
  add_product(1, u, f_);
  double twice_j = 0;
  for (std::size_t c = 0; c < f_.size(); ++c) twice_j += u[c] * f_[c];
  return twice_j / 2;
}

void LinearTissue::remove(TetId t) noexcept {
  has_[t] = 0;
  const ElementTensors element = element_tensors(corners_of(mesh_, t), material_.of(mesh_, t));
  const geometry::Tetrahedron& tet = mesh_.tetrahedra[t];
  for (std::size_t j = 0; j < 4; ++j) {
    --ties_[tet[j]];
    const auto row = stiffness_.neighbour.begin() + stiffness_.start[tet[j]],
               row_end = stiffness_.neighbour.begin() + stiffness_.start[tet[j] + 1];
    for (std::size_t k = 0; k < 4; ++k)
      stiffness_.block[static_cast<std::size_t>(std::lower_bound(row, row_end, tet[k]) -
                                                stiffness_.neighbour.begin())] -= element[j][k];
  }
}

void LinearTissue::restore() noexcept {
  has_ = chosen_;
  std::ranges::copy(uncut_, stiffness_.block.begin());
  count_ties();
}

}  // namespace omentum::physics
