// The innermost loops of the springs, on raw pointers: compiled for this machine's vector unit.
#pragma once

#include "physics/dynamics/padded_nodes.h"

#include <cstdint>

namespace omentum::physics::kernels {

inline constexpr int kSpringLanes = 8;

/// Eight springs, a lane each. A lane without stiffness takes no force, whatever its nodes do.
struct alignas(64) SpringPack {
  double rest[3][kSpringLanes];        // [axis] from the first end to the second, m
  double length[kSpringLanes];         // its norm, m
  double stiffness[kSpringLanes];      // N/m
  std::int32_t node[2][kSpringLanes];  // [end]
};

/// f -= dE/du of `count` packs.
void add_spring_forces(const SpringPack* packs, int count, const PaddedNode* u, PaddedNode* f) noexcept;

/// E of `count` packs, J.
double spring_energy(const SpringPack* packs, int count, const PaddedNode* u) noexcept;

}  // namespace omentum::physics::kernels
