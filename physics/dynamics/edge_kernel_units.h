// The innermost loop of a tensor-mass force, on raw pointers: compiled for each vector unit. No library
// header with inline functions here: what the linker keeps of those may be of any instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace omentum::physics::kernels {

/// Edges side by side: each is of another row.
inline constexpr int kEdgeLanes = 4;
/// Floats of a node's displacement, or force: three components and padding, so that one is one aligned load.
inline constexpr int kNodeFloats = 4;
/// Floats from node to node: a node's displacement and its force share a cache line and an address.
inline constexpr int kNodeStride = 2 * kNodeFloats;
/// Floats of a plane: one diagonal of each lane's block, padded like a node.
inline constexpr int kPlane = kEdgeLanes * kNodeFloats;
/// Floats of the blocks of kEdgeLanes edges, 48 bytes each. Of a block K, padded: plane 0 is K_xx K_yy K_zz,
/// plane 1 K_xy K_yz K_zx, plane 2 K_xz K_yx K_zy. Multiplied by displacements whose components are rotated
/// likewise they are K d; multiplied by d itself, and the products rotated, K^T d.
inline constexpr int kEdgeBlocks = 3 * kPlane;

/// The edges of a mesh, each once: slice s holds, for kEdgeLanes rows (nodes), the steps start[s] ..
/// start[s + 1], and in each step one edge of each row.
struct EdgeSlices {
  const std::int32_t* start;       // [slices + 1]
  const std::int32_t* rows;        // [slices][kEdgeLanes], floats before the node's
  const std::int32_t* neighbours;  // [steps][kEdgeLanes], floats before the node's
  const float* blocks;             // [steps][kEdgeBlocks], 64-byte aligned
  std::int32_t slices;
  std::int32_t nodes;
};

/// With d = u_k - u_n and K the block between n (row) and k (neighbour), over all edges: f_n -= K d,
/// f_k += K^T d, from zero. `u`, `f`: [nodes][3]; in between everything is float. `scratch`:
/// [nodes][kNodeStride], 32-byte aligned.
using EdgeForces = void (*)(const EdgeSlices& slices, const double* u, float* scratch, double* f) noexcept;

/// For each vector unit; edge_kernels() knows which of them this processor has.
void edge_forces_plain(const EdgeSlices& slices, const double* u, float* scratch, double* f) noexcept;
void edge_forces_avx2(const EdgeSlices& slices, const double* u, float* scratch, double* f) noexcept;
void edge_forces_avx512(const EdgeSlices& slices, const double* u, float* scratch, double* f) noexcept;

}  // namespace omentum::physics::kernels
