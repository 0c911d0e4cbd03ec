#include "physics/dynamics/tearing.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace omentum::physics {

namespace {

using geometry::TetId;
using geometry::Vec3;

constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

bool is_removed(std::span<const std::uint8_t> bits, TetId t) {
  const auto byte = static_cast<std::size_t>(t / 8);
  return byte < bits.size() && (bits[byte] >> t % 8 & 1) != 0;
}

using Places = std::array<Vec3, 4>;

Eigen::Matrix3d edges_from_first(const Places& x) {
  Eigen::Matrix3d D;
  D << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  return D;
}

// Tension has the positive sign.
double largest_principal(const Eigen::Matrix3d& stress) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(stress, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

}  // namespace

bool TearLimits::ever() const {
  return std::min({volume_change, mean_elongation, edge_elongation, stress_pa}) < kNever;
}

Tearing::Tearing(const geometry::TetraMesh& mesh, const MaterialMap& material,
                 std::span<const TearLimits> limits)
    : mesh_(mesh), is_shared_(mesh.positions.size()) {
  rest_.reserve(mesh.tetrahedra.size());
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const TetId t(i);
    Places x;
    for (std::size_t c = 0; c < 4; ++c) x[c] = mesh.positions[mesh.tetrahedra[i][c]];
    const Material& of_t = material.of(mesh, t);
    rest_.push_back({edges_from_first(x).inverse(), of_t.lambda(), of_t.mu(), limits[i]});
  }
  loaded_.reserve(mesh.tetrahedra.size());
  chosen_.reserve(mesh.tetrahedra.size());
}

TetStrain Tearing::strain(TetId t, std::span<const double> displacements) const noexcept {
  Places x;
  std::array<double, 6> elongation;
  for (std::size_t c = 0; c < 4; ++c) {
    const geometry::NodeId n = mesh_.tetrahedra[t][c];
    x[c] = mesh_.positions[n] + Eigen::Map<const Vec3>(displacements.data() + 3 * n);
  }
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = kEdges[e];
    const auto& nodes = mesh_.tetrahedra[t];
    elongation[e] = (x[b] - x[a]).norm() / (mesh_.positions[nodes[b]] - mesh_.positions[nodes[a]]).norm() - 1;
  }
  const Rest& rest = rest_[t];
  const Eigen::Matrix3d F = edges_from_first(x) * rest.inverse;
  const Eigen::Matrix3d E = 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d S = rest.lambda_pa * E.trace() * Eigen::Matrix3d::Identity() + 2 * rest.mu_pa * E;
  double sum = 0;
  for (const double of_edge : elongation) sum += of_edge;
  return {std::abs(F.determinant() - 1), sum / 6, *std::ranges::max_element(elongation),
          largest_principal(S)};
}

double Tearing::load(TetId t, std::span<const double> displacements) const noexcept {
  const TearLimits& limits = rest_[t].limits;
  const TetStrain now = strain(t, displacements);
  return std::max({now.volume_change / limits.volume_change, now.mean_elongation / limits.mean_elongation,
                   now.edge_elongation / limits.edge_elongation, now.stress_pa / limits.stress_pa});
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
    if (is_removed(removed, t) || !rest_[i].limits.ever()) continue;
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
