#include "physics/dynamics/carried_mass.h"

#include <algorithm>

namespace omentum::physics {

CarriedMass::CarriedMass(const geometry::TetraMesh& mesh, const MaterialMap& material,
                         std::span<const double> mass)
    : mesh_(mesh), uncut_(mass.begin(), mass.end()), mass_(uncut_), place_(mass.size(), -1) {
  const auto& x = mesh.positions;
  quarter_.reserve(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    quarter_.push_back(material.of(mesh, geometry::TetId(t)).density_kg_m3 *
                       geometry::signed_volume(x[a], x[b], x[c], x[d]) / 4);
  }
  lightened_.reserve(mass.size());
  lost_.reserve(mass.size());
  least_.resize(mass.size());
  restore();
}

void CarriedMass::remove(std::span<const geometry::TetId> tetrahedra) noexcept {
  for (const geometry::NodeId n : lightened_) place_[n] = -1;
  lightened_.clear();
  lost_.clear();
  for (const geometry::TetId t : tetrahedra) {
    for (const geometry::NodeId n : mesh_.tetrahedra[t]) {
      const double left = std::max(mass_[n] - quarter_[t], least_[n]);
      if (left >= mass_[n]) continue;
      if (place_[n] < 0) {
        place_[n] = static_cast<std::int32_t>(lightened_.size());
        lightened_.push_back(n);
        lost_.push_back(0);
      }
      lost_[static_cast<std::size_t>(place_[n])] += mass_[n] - left;
      mass_[n] = left;
    }
  }
}

void CarriedMass::give(std::span<const geometry::NodeId> nodes, std::span<const double> kg) noexcept {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    mass_[nodes[i]] += kg[i];
    least_[nodes[i]] += kLeastShare * kg[i];
  }
}

void CarriedMass::restore() noexcept {
  std::ranges::copy(uncut_, mass_.begin());
  for (std::size_t n = 0; n < least_.size(); ++n) least_[n] = kLeastShare * uncut_[n];
}

}  // namespace omentum::physics
