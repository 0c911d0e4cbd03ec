// Which of the force loops this processor can run.
#pragma once

#include "physics/dynamics/edge_kernel_units.h"

#include <span>

namespace omentum::physics::kernels {

struct EdgeKernel {
  const char* name;
  EdgeForces forces;
};

/// Those that this processor can run, the fastest first; never empty.
std::span<const EdgeKernel> edge_kernels() noexcept;

}  // namespace omentum::physics::kernels
