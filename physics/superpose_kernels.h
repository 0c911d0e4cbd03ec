// The innermost loops over compliance tiles, on raw pointers: compiled for this machine's vector unit.
#pragma once

#include <cstddef>

namespace omentum::physics::kernels {

/// Lanes of a tile: the 16 nodes of a cluster.
inline constexpr int kLanes = 16;
/// Floats of a tile: nine planes, plane 3*i + j is component i per unit force along j.
inline constexpr int kTile = 9 * kLanes;
/// Columns that are superposed in one pass.
inline constexpr int kMaxColumns = 16;

/// u[3][16] = (or += when `accumulate`) sum_q tiles[q] forces[q], q < count <= kMaxColumns. `tiles` are
/// 64-byte aligned; `forces` is [count][3]; `u` needs no alignment.
void superpose_tile(const float* const* tiles, const float* forces, int count, bool accumulate,
                    float* u) noexcept;

/// The same over `clusters` consecutive tiles of each column; u is [clusters][3][16].
void superpose_columns(const float* const* columns, const float* forces, int count, std::size_t clusters,
                       bool accumulate, float* u) noexcept;

/// norms[16]: for each lane an upper bound of the spectral norm of its 3x3 block,
/// sqrt(max absolute row sum * max absolute column sum), rounded up.
void bound_tile(const float* tile, float* norms) noexcept;

}  // namespace omentum::physics::kernels
