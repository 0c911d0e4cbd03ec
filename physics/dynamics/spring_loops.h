// What the springs' kernels of all vector units are made of. Nothing but loops on raw pointers, and no
// library header with inline functions: what the linker keeps of those may be of any instruction set.
#pragma once

#include "physics/dynamics/lanes.h"
#include "physics/dynamics/law_kernels.h"

namespace omentum::physics::kernels {

namespace {

static_assert(kSpringLanes == kPack);

struct Stretched {
  Lanes along[3];  // from the first end to the second
  Lanes length;
};

OMENTUM_LANES_INLINE void stretch(const SpringPack& pack, const PaddedNode* u, Stretched& s) {
  const LaneVectors from = gather(u, pack.node[0]), to = gather(u, pack.node[1]);
  s.along[0] = lanes_at(pack.rest[0]) + (to.x - from.x);
  s.along[1] = lanes_at(pack.rest[1]) + (to.y - from.y);
  s.along[2] = lanes_at(pack.rest[2]) + (to.z - from.z);
  s.length = square_root(s.along[0] * s.along[0] + s.along[1] * s.along[1] + s.along[2] * s.along[2]);
}

inline void add_spring_forces(const SpringPack* packs, int count, const PaddedNode* u,
                              PaddedNode* f) noexcept {
  for (int i = 0; i < count; ++i) {
    const SpringPack& pack = packs[i];
    Stretched s;
    stretch(pack, u, s);
    // ends in one place have no direction
    const LaneMask pulls = (lanes_at(pack.stiffness) > 0) & (s.length > 0);
    const Lanes tension =
        pulls ? lanes_at(pack.stiffness) * (s.length - lanes_at(pack.length)) / s.length : Lanes{};
    const LaneVectors pull{pulls ? tension * s.along[0] : Lanes{}, pulls ? tension * s.along[1] : Lanes{},
                           pulls ? tension * s.along[2] : Lanes{}};
    NodeLanes force[kPack];
    lane_by_lane(pull, force);
    // lane after lane: two of them may share a node
    for (int l = 0; l < kPack; ++l) {
      lanes_of(f[pack.node[0][l]]) += force[l];
      lanes_of(f[pack.node[1][l]]) -= force[l];
    }
  }
}

inline double spring_energy(const SpringPack* packs, int count, const PaddedNode* u) noexcept {
  Lanes sum{};
  for (int i = 0; i < count; ++i) {
    const Lanes stiffness = lanes_at(packs[i].stiffness);
    Stretched s;
    stretch(packs[i], u, s);
    const Lanes elongation = s.length - lanes_at(packs[i].length);
    sum += stiffness > 0 ? 0.5 * stiffness * elongation * elongation : Lanes{};
  }
  double total = 0;
  for (int l = 0; l < kPack; ++l) total += sum[l];
  return total;
}

}  // namespace

}  // namespace omentum::physics::kernels
