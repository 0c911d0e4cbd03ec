#include "physics/dynamics/tensor_books.h"

#include <algorithm>

namespace omentum::physics {

namespace {

bool before(const TensorBooks::Edge& left, const TensorBooks::Edge& right) {
  return left.a != right.a ? left.a < right.a : left.b < right.b;
}

TensorBooks::Edge edge_between(const geometry::Tetrahedron& tet, const std::array<int, 2>& corners) {
  const auto [a, b] = std::minmax(tet[corners[0]], tet[corners[1]]);
  return {a, b};
}

// What nobody uses is nothing: the rounding of what came and went would push on nodes that hang in the air.
void add_share(Eigen::Matrix3d& tensor, std::int32_t& uses, const Eigen::Matrix3d& share, int sign) {
  uses += sign;
  if (uses == 0) {
    tensor.setZero();
  } else {
    tensor += sign * share;
  }
}

}  // namespace

TensorBooks::TensorBooks(const geometry::TetraMesh& mesh, const MaterialMap& material)
    : mesh_(mesh), material_(material) {
  collect_edges();
  vertex_.assign(mesh.positions.size(), Eigen::Matrix3d::Zero());
  edge_.assign(edges_.size(), Eigen::Matrix3d::Zero());
  vertex_uses_.assign(vertex_.size(), 0);
  edge_uses_.assign(edge_.size(), 0);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) add(geometry::TetId(t));
}

void TensorBooks::collect_edges() {
  edges_.reserve(kCorners.size() * mesh_.tetrahedra.size());
  for (const auto& tet : mesh_.tetrahedra) {
    for (const auto& corners : kCorners) edges_.push_back(edge_between(tet, corners));
  }
  std::ranges::sort(edges_, before);
  const auto same = [](const Edge& left, const Edge& right) {
    return left.a == right.a && left.b == right.b;
  };
  edges_.erase(std::unique(edges_.begin(), edges_.end(), same), edges_.end());
  edges_.shrink_to_fit();
  tet_edges_.reserve(mesh_.tetrahedra.size());
  for (const auto& tet : mesh_.tetrahedra) {
    TetEdges& own = tet_edges_.emplace_back();
    for (std::size_t i = 0; i < kCorners.size(); ++i) {
      const auto place = std::ranges::lower_bound(edges_, edge_between(tet, kCorners[i]), before);
      own[i] = static_cast<std::int32_t>(place - edges_.begin());
    }
  }
}

void TensorBooks::count(geometry::TetId t, int sign) noexcept {
  const geometry::Tetrahedron& tet = mesh_.tetrahedra[t];
  const ElementTensors K = element_tensors(corners_of(mesh_, t), material_.of(mesh_, t));
  for (int j = 0; j < 4; ++j) add_share(vertex_[tet[j]], vertex_uses_[tet[j]], K[j][j], sign);
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const auto [j, k] = kCorners[i];
    const std::int32_t e = tet_edges_[t][i];
    add_share(edge_[e], edge_uses_[e], tet[j] < tet[k] ? K[j][k] : K[k][j], sign);
  }
}

}  // namespace omentum::physics
