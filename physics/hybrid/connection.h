// How displacements and forces pass over the border of a hybrid organ.
#pragma once

#include "physics/hybrid/border_tie.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// Connection nodes c, of the precomputed part's surface, are led by nodes m of the dynamic one: w_c = P u_m,
/// and what they push is felt there as P^T f_c. Where the parts share their nodes these lead themselves, and
/// P is 1. All memory is taken at construction; one thread at a time.
class Connection {
 public:
  /// `surface`: of the precomputed part; `tie`: of parts that share no nodes, else null.
  Connection(const MeshSplit& split, const geometry::Surface& surface, const BorderTie* tie);

  std::span<const geometry::SurfaceId> nodes() const { return nodes_; }   // [c]
  std::span<const geometry::NodeId> leaders() const { return leaders_; }  // [m], of the dynamic part
  bool is_tied() const { return weights_.size() != 0; }

  /// P^T S P of the leaders, for S [3c x 3c].
  AddedStiffness added(const Eigen::MatrixXd& S) const;
  /// P^T m, kg, [m], for lumped masses of the connection nodes, [c]. All of it sums up, and about every axis.
  std::vector<double> carried(std::span<const double> mass) const;

  /// w_c = P (u_m + b v_m), [3c]; u, v: [3d] of the dynamic part.
  void lead(std::span<const double> u, std::span<const double> v, double b, std::span<double> w_c) noexcept;
  /// P^T f_c, [3m], for f_c [3c].
  void gather(std::span<const double> f_c, std::span<double> f_m) const noexcept;
  /// The same, added to f, [3d] of the dynamic part.
  void add_gathered(std::span<const double> f_c, std::span<double> f) noexcept;

 private:
  std::vector<geometry::SurfaceId> nodes_;
  std::vector<geometry::NodeId> leaders_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights_;  // [c x m]; none: 1
  std::vector<double> led_;                                                         // [3m]
};

}  // namespace omentum::physics
