// Eight doubles as one value, and the vectors of nodes carried into and out of them. For the loops that are
// compiled for each vector unit (law_kernels.h), and nobody else.
#pragma once

#include "physics/dynamics/padded_nodes.h"

#include <cstdint>

namespace omentum::physics::kernels {

/// Elements of a pack: a vector register where it is wide enough; the compiler splits it where not.
inline constexpr int kPack = 8;

typedef double Lanes __attribute__((vector_size(kPack * sizeof(double))));
typedef long long LaneMask __attribute__((vector_size(kPack * sizeof(double))));  // -1: true, 0: false

// Always inlined: a vector that is passed in a register would change with the instruction set.
#define OMENTUM_LANES_INLINE static inline __attribute__((always_inline))

OMENTUM_LANES_INLINE const Lanes& lanes_at(const double* aligned) {
  return *reinterpret_cast<const Lanes*>(aligned);
}

OMENTUM_LANES_INLINE Lanes& lanes_at(double* aligned) {
  return *reinterpret_cast<Lanes*>(aligned);
}

/// A vector of each lane.
struct LaneVectors {
  Lanes x, y, z;
};

typedef double NodeLanes __attribute__((vector_size(4 * sizeof(double))));

OMENTUM_LANES_INLINE const NodeLanes& lanes_of(const PaddedNode& node) {
  return *reinterpret_cast<const NodeLanes*>(node.v);
}

OMENTUM_LANES_INLINE NodeLanes& lanes_of(PaddedNode& node) {
  return *reinterpret_cast<NodeLanes*>(node.v);
}

/// Those of nodes[which[lane]].
OMENTUM_LANES_INLINE LaneVectors gather(const PaddedNode* nodes, const std::int32_t* which) {
  Lanes pairs[4];  // x y z . of one node, x y z . of the next one
  for (int i = 0; i < 4; ++i) {
    const NodeLanes& even = lanes_of(nodes[which[2 * i]]);
    const NodeLanes& odd = lanes_of(nodes[which[2 * i + 1]]);
    pairs[i] = __builtin_shufflevector(even, odd, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  const Lanes xy_low = __builtin_shufflevector(pairs[0], pairs[1], 0, 4, 8, 12, 1, 5, 9, 13);
  const Lanes xy_high = __builtin_shufflevector(pairs[2], pairs[3], 0, 4, 8, 12, 1, 5, 9, 13);
  const Lanes z_low = __builtin_shufflevector(pairs[0], pairs[1], 2, 6, 10, 14, 3, 7, 11, 15);
  const Lanes z_high = __builtin_shufflevector(pairs[2], pairs[3], 2, 6, 10, 14, 3, 7, 11, 15);
  return {__builtin_shufflevector(xy_low, xy_high, 0, 1, 2, 3, 8, 9, 10, 11),
          __builtin_shufflevector(xy_low, xy_high, 4, 5, 6, 7, 12, 13, 14, 15),
          __builtin_shufflevector(z_low, z_high, 0, 1, 2, 3, 8, 9, 10, 11)};
}

/// vectors[lane] = x y z 0 of each lane.
OMENTUM_LANES_INLINE void lane_by_lane(const LaneVectors& v, NodeLanes* vectors) {
  const Lanes xy[2] = {__builtin_shufflevector(v.x, v.y, 0, 8, 1, 9, 2, 10, 3, 11),
                       __builtin_shufflevector(v.x, v.y, 4, 12, 5, 13, 6, 14, 7, 15)};
  const Lanes z[2] = {__builtin_shufflevector(v.z, Lanes{}, 0, 8, 1, 9, 2, 10, 3, 11),
                      __builtin_shufflevector(v.z, Lanes{}, 4, 12, 5, 13, 6, 14, 7, 15)};
  for (int half = 0; half < 2; ++half) {
    const Lanes first = __builtin_shufflevector(xy[half], z[half], 0, 1, 8, 9, 2, 3, 10, 11);
    const Lanes second = __builtin_shufflevector(xy[half], z[half], 4, 5, 12, 13, 6, 7, 14, 15);
    vectors[4 * half] = __builtin_shufflevector(first, first, 0, 1, 2, 3);
    vectors[4 * half + 1] = __builtin_shufflevector(first, first, 4, 5, 6, 7);
    vectors[4 * half + 2] = __builtin_shufflevector(second, second, 0, 1, 2, 3);
    vectors[4 * half + 3] = __builtin_shufflevector(second, second, 4, 5, 6, 7);
  }
}

OMENTUM_LANES_INLINE Lanes square_root(const Lanes& x) {
  Lanes root;
  for (int l = 0; l < kPack; ++l) root[l] = __builtin_sqrt(x[l]);
  return root;
}

OMENTUM_LANES_INLINE Lanes absolute(const Lanes& x) {
  return x < 0 ? -x : x;
}

OMENTUM_LANES_INLINE bool any(const LaneMask& mask) {
  long long found = 0;
  for (int l = 0; l < kPack; ++l) found |= mask[l];
  return found != 0;
}

}  // namespace omentum::physics::kernels
