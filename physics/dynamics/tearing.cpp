#include "physics/dynamics/tearing.h"

#include "geometry/tetra_bits.h"
#include "geometry/tetra_edges.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omentum::physics {

namespace {

using geometry::TetId;
using geometry::Vec3;

using Places = std::array<Vec3, 4>;

std::array<double, 6> edge_lengths(const Places& x) {
  std::array<double, 6> length_m;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = geometry::kTetraEdges[e];
    length_m[e] = (x[b] - x[a]).norm();
  }
  return length_m;
}

double mean(const std::array<double, 6>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / 6;
}

}  // namespace

bool TearLimits::ever() const {
  return std::min({volume_change, mean_elongation, edge_elongation, stress_pa}) < kNever;
}

Tearing::Tearing(const geometry::TetraMesh& mesh, const MaterialMap& material,
                 std::span<const TearLimits> limits)
    : mesh_(mesh), gradients_(mesh), is_shared_(mesh.positions.size()) {
  rest_.reserve(mesh.tetrahedra.size());
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const TetId t(i);
    Places x;
    for (std::size_t c = 0; c < 4; ++c) x[c] = mesh.positions[mesh.tetrahedra[i][c]];
    const Material& of_t = material.of(mesh, t);
    rest_.push_back({edge_lengths(x), of_t.lambda(), of_t.mu(), limits[i]});
  }
  loaded_.reserve(mesh.tetrahedra.size());
  chosen_.reserve(mesh.tetrahedra.size());
}

struct Tearing::Deformed {
  std::array<double, 6> elongation;
  double volume_ratio;
  Eigen::Matrix3d stress_pa;
};

Tearing::Deformed Tearing::deform(TetId t, std::span<const double> displacements) const noexcept {
  Places x;
  Deformed now;
  for (std::size_t c = 0; c < 4; ++c) {
    const geometry::NodeId n = mesh_.tetrahedra[t][c];
    x[c] = mesh_.positions[n] + Eigen::Map<const Vec3>(displacements.data() + 3 * n);
  }
  const Rest& rest = rest_[t];
  const std::array<double, 6> length_m = edge_lengths(x);
  for (std::size_t e = 0; e < 6; ++e) now.elongation[e] = length_m[e] / rest.length_m[e] - 1;
  const Eigen::Matrix3d F = gradients_.at(t, displacements);
  now.volume_ratio = F.determinant();
  now.stress_pa = hooke_stress(rest.lambda_pa, rest.mu_pa, green_strain(F));
  return now;
}

TetStrain Tearing::strain(TetId t, std::span<const double> displacements) const noexcept {
  const Deformed now = deform(t, displacements);
  return {std::abs(now.volume_ratio - 1), mean(now.elongation), *std::ranges::max_element(now.elongation),
          largest_principal(now.stress_pa)};
}

double Tearing::load(TetId t, std::span<const double> displacements) const noexcept {
  const TearLimits& limits = rest_[t].limits;
  const Deformed now = deform(t, displacements);
  const double shape = std::max({std::abs(now.volume_ratio - 1) / limits.volume_change,
                                 mean(now.elongation) / limits.mean_elongation,
                                 *std::ranges::max_element(now.elongation) / limits.edge_elongation});
  // no principal stress is above the norm, and most tissue is far from its limit
  if (now.stress_pa.norm() <= limits.stress_pa) return shape;
  return std::max(shape, largest_principal(now.stress_pa) / limits.stress_pa);
}

bool Tearing::meets_chosen(TetId t) const noexcept {
  return std::ranges::any_of(mesh_.tetrahedra[t], [&](geometry::NodeId n) { return is_shared_[n] != 0; });
}

void Tearing::choose(TetId t) noexcept {
  chosen_.push_back(t);
  for (const geometry::NodeId n : mesh_.tetrahedra[t]) is_shared_[n] = 1;
}

std::span<const TetId> Tearing::check(std::span<const double> displacements,
                                      std::span<const std::uint8_t> removed, std::size_t most) noexcept {
  loaded_.clear();
  chosen_.clear();
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    const TetId t(i);
    if (geometry::is_set(removed, t) || !rest_[i].limits.ever()) continue;
    const double now = load(t, displacements);
    if (now > 1) loaded_.push_back({now, t});
  }
  // equal loads in the mesh's order, so that every machine tears alike
  std::ranges::sort(loaded_, [](const Loaded& a, const Loaded& b) {
    return a.load != b.load ? a.load > b.load : a.t < b.t;
  });
  for (const Loaded& next : loaded_) {
    if (chosen_.size() == most) break;
    if (!meets_chosen(next.t)) choose(next.t);
  }
  for (const TetId t : chosen_)
    for (const geometry::NodeId n : mesh_.tetrahedra[t]) is_shared_[n] = 0;
  return chosen_;
}

}  // namespace omentum::physics
