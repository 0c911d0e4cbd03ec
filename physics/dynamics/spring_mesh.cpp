#include "physics/dynamics/spring_mesh.h"

#include <algorithm>
#include <tuple>

namespace omentum::physics {

namespace {

using kernels::kSpringLanes;
using kernels::SpringPack;

// One edge of one tetrahedron.
struct Side {
  NodeId from, to;  // from < to
  std::int32_t tetrahedron;
  std::size_t edge;  // of the tetrahedron's six
  double stiffness;

  std::pair<NodeId, NodeId> ends() const { return {from, to}; }
};

std::vector<Side> sides_of(const geometry::TetraMesh& mesh, const MaterialMap& material, SpringFit fit) {
  std::vector<Side> sides;
  sides.reserve(kTetEdges.size() * mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const geometry::TetId id(t);
    const auto stiffness = fit_springs(corners_of(mesh, id), material.of(mesh, id), fit);
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const auto [from, to] =
          std::minmax(mesh.tetrahedra[t][kTetEdges[e][0]], mesh.tetrahedra[t][kTetEdges[e][1]]);
      sides.push_back({from, to, static_cast<std::int32_t>(t), e, stiffness[e]});
    }
  }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.from, s.to, s.tetrahedron); });
  return sides;
}

void place(SpringPack& pack, std::size_t lane, const Side& side, const geometry::TetraMesh& mesh) {
  const Vec3 along = mesh.positions[side.to] - mesh.positions[side.from];
  for (int axis = 0; axis < 3; ++axis) pack.rest[axis][lane] = along[axis];
  pack.length[lane] = along.norm();
  pack.node[0][lane] = side.from;
  pack.node[1][lane] = side.to;
}

}  // namespace

SpringMesh::SpringMesh(const geometry::TetraMesh& mesh, const MaterialMap& material, SpringFit fit,
                       const kernels::LawKernels& unit)
    : kernels_(&unit),
      edges_of_(mesh.tetrahedra.size()),
      left_(mesh.tetrahedra.size(), 1),
      u_(mesh.positions.size()),
      f_(mesh.positions.size()) {
  const std::vector<Side> sides = sides_of(mesh, material, fit);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (s == 0 || sides[s].ends() != sides[s - 1].ends()) {
      const std::size_t lane = start_.size() % kSpringLanes;
      if (lane == 0) packs_.emplace_back();
      place(packs_.back(), lane, sides[s], mesh);
      start_.push_back(static_cast<std::int32_t>(s));
    }
    shares_.push_back({sides[s].tetrahedron, sides[s].stiffness});
    edges_of_[static_cast<std::size_t>(sides[s].tetrahedron)][sides[s].edge] =
        static_cast<std::int32_t>(start_.size()) - 1;
  }
  start_.push_back(static_cast<std::int32_t>(sides.size()));
  for (std::int32_t edge = 0; edge < edge_count(); ++edge) sum_shares(edge);
}

void SpringMesh::forces(std::span<const double> u, std::span<double> f) noexcept {
  kernels::pad(u.data(), u_.size(), u_.data());
  std::ranges::fill(f_, kernels::PaddedNode{});
  kernels_->add_spring_forces(packs_.data(), static_cast<int>(packs_.size()), u_.data(), f_.data());
  kernels::unpad(f_.data(), f_.size(), f.data());
}

double SpringMesh::energy(std::span<const double> u) const noexcept {
  kernels::pad(u.data(), u_.size(), u_.data());
  return kernels_->spring_energy(packs_.data(), static_cast<int>(packs_.size()), u_.data());
}

void SpringMesh::remove(geometry::TetId t) noexcept {
  set_left(t, false);
}

void SpringMesh::add(geometry::TetId t) noexcept {
  set_left(t, true);
}

void SpringMesh::set_left(geometry::TetId t, bool left) noexcept {
  left_[static_cast<std::size_t>(t)] = left ? 1 : 0;
  for (const std::int32_t edge : edges_of_[static_cast<std::size_t>(t)]) sum_shares(edge);
}

// Anew each time, in one order: subtracting would leave a rounding, and an edge without tetrahedra a spring.
void SpringMesh::sum_shares(std::int32_t edge) noexcept {
  double stiffness = 0;
  for (std::int32_t s = start_[edge]; s < start_[edge + 1]; ++s) {
    if (left_[static_cast<std::size_t>(shares_[s].tetrahedron)] != 0) stiffness += shares_[s].stiffness;
  }
  packs_[static_cast<std::size_t>(edge / kSpringLanes)].stiffness[edge % kSpringLanes] = stiffness;
}

}  // namespace omentum::physics
