// A dense symmetric matrix that many vectors are multiplied by.
#pragma once

#include "physics/dynamics/huge_pages.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace omentum::physics {

/// Half of it, in the order in which a product reads it: it is the memory that such products wait for. All
/// memory is taken at construction; one thread at a time.
class SymmetricTiles {
 public:
  /// Of what lies on and below the diagonal of `A`, [n x n].
  explicit SymmetricTiles(const Eigen::MatrixXd& A);

  std::size_t size() const { return size_; }
  /// y = A x, [n]; they may be the same.
  void product(std::span<const double> x, std::span<double> y) noexcept;

 private:
  std::size_t size_;
  std::vector<double, HugePages<double>> tiles_, x_, y_;
};

}  // namespace omentum::physics
