// The loops of edge_kernel_units.h. Each edge_kernels_*.cpp compiles them for one vector unit: no library
// header with inline functions may be included here or there.
#pragma once

#include "physics/dynamics/edge_kernel_units.h"

namespace omentum::physics::kernels {

// Of each file that includes this its own: one copy for all would be of any instruction set.
namespace {

typedef float Node __attribute__((vector_size(kNodeFloats * sizeof(float)), may_alias));
typedef double WideNode __attribute__((vector_size(kNodeFloats * sizeof(double))));

// The same at any address.
struct __attribute__((packed, may_alias)) LooseWideNode {
  WideNode node;
};

inline const Node& node(const float* p) {
  return *reinterpret_cast<const Node*>(p);
}
inline Node& node(float* p) {
  return *reinterpret_cast<Node*>(p);
}

// As many lanes as a register holds. Of each lane (x, y, z, 0): (y, z, x, 0), and (z, x, y, 0).
#if defined(__AVX512F__) && defined(__AVX512DQ__)

inline constexpr int kLanes = 4;
typedef float Lanes __attribute__((vector_size(kLanes * kNodeFloats * sizeof(float)), may_alias));

inline Lanes rotated(Lanes v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3, 5, 6, 4, 7, 9, 10, 8, 11, 13, 14, 12, 15);
}
inline Lanes rotated_twice(Lanes v) {
  return __builtin_shufflevector(v, v, 2, 0, 1, 3, 6, 4, 5, 7, 10, 8, 9, 11, 14, 12, 13, 15);
}
template <class Offset>
inline Lanes gathered(const float* nodes, const Offset* at) {
  const auto low = __builtin_shufflevector(node(nodes + at[0]), node(nodes + at[1]), 0, 1, 2, 3, 4, 5, 6, 7);
  const auto high = __builtin_shufflevector(node(nodes + at[2]), node(nodes + at[3]), 0, 1, 2, 3, 4, 5, 6, 7);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
// One after the other: two lanes may be of the same node.
template <class Offset>
inline void scatter(Lanes v, float* nodes, const Offset* at) {
  node(nodes + at[0]) += __builtin_shufflevector(v, v, 0, 1, 2, 3);
  node(nodes + at[1]) += __builtin_shufflevector(v, v, 4, 5, 6, 7);
  node(nodes + at[2]) += __builtin_shufflevector(v, v, 8, 9, 10, 11);
  node(nodes + at[3]) += __builtin_shufflevector(v, v, 12, 13, 14, 15);
}

#elif defined(__AVX2__)

inline constexpr int kLanes = 2;
typedef float Lanes __attribute__((vector_size(kLanes * kNodeFloats * sizeof(float)), may_alias));

inline Lanes rotated(Lanes v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3, 5, 6, 4, 7);
}
inline Lanes rotated_twice(Lanes v) {
  return __builtin_shufflevector(v, v, 2, 0, 1, 3, 6, 4, 5, 7);
}
template <class Offset>
inline Lanes gathered(const float* nodes, const Offset* at) {
  return __builtin_shufflevector(node(nodes + at[0]), node(nodes + at[1]), 0, 1, 2, 3, 4, 5, 6, 7);
}
template <class Offset>
inline void scatter(Lanes v, float* nodes, const Offset* at) {
  node(nodes + at[0]) += __builtin_shufflevector(v, v, 0, 1, 2, 3);
  node(nodes + at[1]) += __builtin_shufflevector(v, v, 4, 5, 6, 7);
}

#else

inline constexpr int kLanes = 1;
typedef Node Lanes;

inline Lanes rotated(Lanes v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}
inline Lanes rotated_twice(Lanes v) {
  return __builtin_shufflevector(v, v, 2, 0, 1, 3);
}
template <class Offset>
inline Lanes gathered(const float* nodes, const Offset* at) {
  return node(nodes + at[0]);
}
template <class Offset>
inline void scatter(Lanes v, float* nodes, const Offset* at) {
  node(nodes + at[0]) += v;
}

#endif

inline const Lanes& lanes(const float* p) {
  return *reinterpret_cast<const Lanes*>(p);
}

// To float, padded, with forces of zero beside; each node but the last by a load that reaches into the next
// one.
inline void spread(const double* u, std::int32_t count, float* nodes) {
  for (std::int32_t n = 0; n + 1 < count; ++n, u += 3, nodes += kNodeStride) {
    const Node rounded = __builtin_convertvector(reinterpret_cast<const LooseWideNode*>(u)->node, Node);
    node(nodes) = __builtin_shufflevector(rounded, Node{}, 0, 1, 2, 4);
    node(nodes + kNodeFloats) = Node{};
  }
  node(nodes) = Node{static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2]), 0};
  node(nodes + kNodeFloats) = Node{};
}

// Back to double: what each store has too much, the next one overwrites.
inline void collect(const float* nodes, std::int32_t count, double* f) {
  for (std::int32_t n = 0; n + 1 < count; ++n, f += 3, nodes += kNodeStride)
    reinterpret_cast<LooseWideNode*>(f)->node = __builtin_convertvector(node(nodes + kNodeFloats), WideNode);
  for (int i = 0; i < 3; ++i) f[i] = nodes[kNodeFloats + i];
}

// kLanes rows of a slice from `lane` on.
inline void take_rows(const EdgeSlices& slices, std::int32_t slice, int lane, float* nodes) {
  float* const forces = nodes + kNodeFloats;
  const std::int32_t* rows = slices.rows + slice * kEdgeLanes + lane;
  const std::ptrdiff_t begin = slices.start[slice], end = slices.start[slice + 1];
  const std::int32_t* neighbours = slices.neighbours + begin * kEdgeLanes + lane;
  const std::int32_t* const neighbours_end = slices.neighbours + end * kEdgeLanes;
  const float* block = slices.blocks + begin * kEdgeBlocks + lane * kNodeFloats;
  const Lanes u_rows = gathered(nodes, rows);
  Lanes pull{};
  for (; neighbours < neighbours_end; neighbours += kEdgeLanes, block += kEdgeBlocks) {
    const Lanes &K_0 = lanes(block), &K_1 = lanes(block + kPlane), &K_2 = lanes(block + 2 * kPlane);
    // read once: to the compiler a store of forces may change them
    std::ptrdiff_t at[kLanes];
    for (int l = 0; l < kLanes; ++l) at[l] = neighbours[l];
    const Lanes d = gathered(nodes, at) - u_rows;
    const Lanes along = K_0 * d;
    pull -= along + K_1 * rotated(d) + K_2 * rotated_twice(d);
    scatter(along + rotated(K_2 * d) + rotated_twice(K_1 * d), forces, at);
  }
  scatter(pull, forces, rows);
}

inline void edge_forces_here(const EdgeSlices& slices, const double* u, float* nodes, double* f) {
  spread(u, slices.nodes, nodes);
  for (std::int32_t slice = 0; slice < slices.slices; ++slice) {
    for (int lane = 0; lane < kEdgeLanes; lane += kLanes) take_rows(slices, slice, lane, nodes);
  }
  collect(nodes, slices.nodes, f);
}

}  // namespace

}  // namespace omentum::physics::kernels
