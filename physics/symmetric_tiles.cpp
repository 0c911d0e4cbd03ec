#include "physics/symmetric_tiles.h"

#include "physics/symmetric_kernels.h"

#include <algorithm>

namespace omentum::physics {

SymmetricTiles::SymmetricTiles(const Eigen::MatrixXd& A) : size_(static_cast<std::size_t>(A.rows())) {
  const auto n = A.rows(), side = static_cast<Eigen::Index>(kernels::symmetric_tile_side());
  const Eigen::Index columns = (n + side - 1) / side;
  tiles_.reserve(static_cast<std::size_t>(columns * (columns + 1) / 2 * side * side));
  for (Eigen::Index j = 0; j < columns * side; j += side) {
    for (Eigen::Index i = j; i < columns * side; i += side) {
      for (Eigen::Index column = j; column < j + side; ++column)
        for (Eigen::Index row = i; row < i + side; ++row)
          tiles_.push_back(row < n && column < n ? A(std::max(row, column), std::min(row, column)) : 0.0);
    }
  }
  x_.resize(static_cast<std::size_t>(columns * side));
  y_.resize(x_.size());
}

void SymmetricTiles::product(std::span<const double> x, std::span<double> y) noexcept {
  std::ranges::copy(x, x_.begin());
  kernels::symmetric_product(tiles_.data(), x_.size() / kernels::symmetric_tile_side(), x_.data(), y_.data());
  std::copy_n(y_.begin(), size_, y.begin());
}

}  // namespace omentum::physics
