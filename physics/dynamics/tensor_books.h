// The tensors of a tensor-mass model, kept exactly while tetrahedra come and go (Cotin 1998, section 5.2).
#pragma once

#include "physics/element_tensors.h"
#include "physics/material_map.h"

#include <array>
#include <vector>

namespace omentum::physics {

/// K of a mesh as one tensor per node and one per edge, in double, N/m. One thread at a time; only
/// construction allocates.
class TensorBooks {
 public:
  struct Edge {
    NodeId a, b;  // a < b
  };
  /// The edges of a tetrahedron, in the order of kCorners.
  using TetEdges = std::array<std::int32_t, 6>;
  static constexpr std::array<std::array<int, 2>, 6> kCorners{
      {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

  /// All tetrahedra are added. `mesh` outlives the books.
  TensorBooks(const geometry::TetraMesh& mesh, const MaterialMap& material);

  std::size_t node_count() const { return vertex_.size(); }
  /// By a, then b. An edge stays when its last tetrahedron goes; its tensor is zero then.
  const std::vector<Edge>& edges() const { return edges_; }
  const TetEdges& edges_of(geometry::TetId t) const { return tet_edges_[t]; }

  /// K_nn: minus the sum of K_nk over the neighbours k.
  const Eigen::Matrix3d& vertex(NodeId n) const { return vertex_[n]; }
  /// K_ab of edges()[e]; K_ba is its transpose.
  const Eigen::Matrix3d& edge(std::size_t e) const { return edge_[e]; }

  /// The ten tensors of `t`, four at its nodes and six at its edges, are added or subtracted.
  void add(geometry::TetId t) noexcept { count(t, 1); }
  void remove(geometry::TetId t) noexcept { count(t, -1); }

 private:
  void collect_edges();
  void count(geometry::TetId t, int sign) noexcept;

  const geometry::TetraMesh& mesh_;
  MaterialMap material_;
  std::vector<Edge> edges_;                            // [E]
  std::vector<TetEdges> tet_edges_;                    // [T] into `edges_`
  std::vector<Eigen::Matrix3d> vertex_, edge_;         // [N], [E]
  std::vector<std::int32_t> vertex_uses_, edge_uses_;  // tetrahedra left around each
};

}  // namespace omentum::physics
