// Eight doubles as one value, and nodes' numbers carried into and out of them. For kernel files only
// (omentum_native): whoever else includes it compiles it for another instruction set.
#pragma once

#include <cstdint>

namespace omentum::physics::kernels {

/// Elements of a pack: a vector register where it is wide enough; the compiler splits it where not.
inline constexpr int kPack = 8;

typedef double Lanes __attribute__((vector_size(kPack * sizeof(double))));
typedef long long LaneMask __attribute__((vector_size(kPack * sizeof(double))));  // -1: true, 0: false

// Always inlined: a vector that is passed in a register would change with the instruction set.
#define OMENTUM_LANES_INLINE inline __attribute__((always_inline))

OMENTUM_LANES_INLINE const Lanes& lanes_at(const double* aligned) {
  return *reinterpret_cast<const Lanes*>(aligned);
}

OMENTUM_LANES_INLINE Lanes& lanes_at(double* aligned) {
  return *reinterpret_cast<Lanes*>(aligned);
}

/// values[first[lane]] of each lane.
OMENTUM_LANES_INLINE Lanes gather(const double* values, const std::int32_t* first) {
  Lanes lanes;
  for (int l = 0; l < kPack; ++l) lanes[l] = values[first[l]];
  return lanes;
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
