// The loop of edge_kernel_units.h. Each edge_kernels_*.cpp compiles it for one vector unit: no library header
// with inline functions may be included here or there.
#pragma once

#include "physics/dynamics/edge_kernel_units.h"

namespace omentum::physics::kernels {

// Of each file that includes this its own: one copy for all would be of any instruction set.
namespace {

typedef float Node __attribute__((vector_size(kNodeFloats * sizeof(float)), may_alias));
typedef float Lanes __attribute__((vector_size(kPlane * sizeof(float)), may_alias));

inline const Node& node(const float* p) {
  return *reinterpret_cast<const Node*>(p);
}
inline Node& node(float* p) {
  return *reinterpret_cast<Node*>(p);
}

// clang-format off
// Of each lane (x, y, z, 0): (y, z, x, 0) and (z, x, y, 0).
#define OMENTUM_ROTATED(v) \
  __builtin_shufflevector(v, v, 1, 2, 0, 3, 5, 6, 4, 7, 9, 10, 8, 11, 13, 14, 12, 15)
#define OMENTUM_ROTATED_TWICE(v) \
  __builtin_shufflevector(v, v, 2, 0, 1, 3, 6, 4, 5, 7, 10, 8, 9, 11, 14, 12, 13, 15)
#define OMENTUM_GATHERED(source, at)                                                                      \
  __builtin_shufflevector(                                                                                \
      __builtin_shufflevector(node(source + at[0]), node(source + at[1]), 0, 1, 2, 3, 4, 5, 6, 7),        \
      __builtin_shufflevector(node(source + at[2]), node(source + at[3]), 0, 1, 2, 3, 4, 5, 6, 7),        \
      0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
// clang-format on

inline void edge_forces_here(const EdgeSlices& slices, const float* u, float* f) noexcept {
  for (std::int32_t s = 0; s < slices.slices; ++s) {
    const std::int32_t* row = slices.rows + s * kEdgeLanes;
    const Lanes u_row = OMENTUM_GATHERED(u, row);
    Lanes pull{};
    for (std::int32_t step = slices.start[s]; step < slices.start[s + 1]; ++step) {
      const std::int32_t* neighbour = slices.neighbours + static_cast<std::ptrdiff_t>(step) * kEdgeLanes;
      const float* block = slices.blocks + static_cast<std::ptrdiff_t>(step) * kEdgeBlocks;
      const Lanes& K_0 = *reinterpret_cast<const Lanes*>(block);
      const Lanes& K_1 = *reinterpret_cast<const Lanes*>(block + kPlane);
      const Lanes& K_2 = *reinterpret_cast<const Lanes*>(block + 2 * kPlane);
      const Lanes d = OMENTUM_GATHERED(u, neighbour) - u_row;
      const Lanes along = K_0 * d;
      pull += along + K_1 * OMENTUM_ROTATED(d) + K_2 * OMENTUM_ROTATED_TWICE(d);
      const Lanes once = K_2 * d, twice = K_1 * d;
      const Lanes push = along + OMENTUM_ROTATED(once) + OMENTUM_ROTATED_TWICE(twice);
      // one after the other: two lanes may have the same neighbour
      node(f + neighbour[0]) += __builtin_shufflevector(push, push, 0, 1, 2, 3);
      node(f + neighbour[1]) += __builtin_shufflevector(push, push, 4, 5, 6, 7);
      node(f + neighbour[2]) += __builtin_shufflevector(push, push, 8, 9, 10, 11);
      node(f + neighbour[3]) += __builtin_shufflevector(push, push, 12, 13, 14, 15);
    }
    node(f + row[0]) -= __builtin_shufflevector(pull, pull, 0, 1, 2, 3);
    node(f + row[1]) -= __builtin_shufflevector(pull, pull, 4, 5, 6, 7);
    node(f + row[2]) -= __builtin_shufflevector(pull, pull, 8, 9, 10, 11);
    node(f + row[3]) -= __builtin_shufflevector(pull, pull, 12, 13, 14, 15);
  }
}

}  // namespace

}  // namespace omentum::physics::kernels
