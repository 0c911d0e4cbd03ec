// What ties nodes of a body together beside its tetrahedra, at work.
#pragma once

#include "physics/stiffness.h"
#include "physics/symmetric_tiles.h"

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace omentum::physics {

/// f = K u of an AddedStiffness, dense. Vectors are [3N] of the whole body. All memory is taken at
/// construction; one thread at a time.
class AddedForces {
 public:
  explicit AddedForces(const AddedStiffness& added);

  /// f += scale K u, N; only its nodes are touched.
  void add_product(double scale, std::span<const double> u, std::span<double> f) noexcept;
  /// u^T K u / 2, J.
  double energy(std::span<const double> u) noexcept;

  /// The nodes that are tied.
  std::span<const geometry::NodeId> nodes() const { return nodes_; }

 private:
  void multiply(std::span<const double> u) noexcept;

  std::vector<geometry::NodeId> nodes_;
  SymmetricTiles stiffness_;
  Eigen::VectorXd u_, f_;  // [3n]
};

}  // namespace omentum::physics
