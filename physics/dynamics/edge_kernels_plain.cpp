#include "physics/dynamics/edge_loops.h"

namespace omentum::physics::kernels {

void edge_forces_plain(const EdgeSlices& slices, const float* u, float* f) noexcept {
  edge_forces_here(slices, u, f);
}

}  // namespace omentum::physics::kernels
