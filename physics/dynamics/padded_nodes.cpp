#include "physics/dynamics/padded_nodes.h"

namespace omentum::physics::kernels {

void pad(const double* values, std::size_t count, PaddedNode* nodes) noexcept {
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) nodes[n].v[axis] = values[3 * n + axis];
  }
}

void unpad(const PaddedNode* nodes, std::size_t count, double* values) noexcept {
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) values[3 * n + axis] = nodes[n].v[axis];
  }
}

}  // namespace omentum::physics::kernels
