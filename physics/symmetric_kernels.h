// The innermost loop over a symmetric matrix in tiles, on raw pointers: compiled for this machine's vector
// unit.
#pragma once

#include <cstddef>

namespace omentum::physics::kernels {

/// Rows and columns of a tile: as many doubles as the vector unit takes at once.
std::size_t symmetric_tile_side() noexcept;

/// y = A x. `tiles`: of each column of tiles in turn, those from the diagonal down, [side][side], column by
/// column of a tile. `x`, `y`: [side * columns], and not the same. All are 64-byte aligned.
void symmetric_product(const double* tiles, std::size_t columns, const double* x, double* y) noexcept;

}  // namespace omentum::physics::kernels
