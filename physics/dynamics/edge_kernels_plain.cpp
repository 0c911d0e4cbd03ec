#include "physics/dynamics/edge_loops.h"

namespace omentum::physics::kernels {

void edge_forces_plain(const EdgeSlices& slices, const double* u, float* scratch, double* f) noexcept {
  edge_forces_here(slices, u, scratch, f);
}

}  // namespace omentum::physics::kernels
