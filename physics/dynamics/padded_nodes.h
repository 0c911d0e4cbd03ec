// Three components of each node as vector units like them. No inline functions: kernel files include it.
#pragma once

#include <cstddef>

namespace omentum::physics::kernels {

/// x y z of a node, and nothing: one aligned load.
struct alignas(32) PaddedNode {
  double v[4];
};

/// values[count][3] into nodes[count]; the fourth of each is left as it is.
void pad(const double* values, std::size_t count, PaddedNode* nodes) noexcept;

/// nodes[count] into values[count][3].
void unpad(const PaddedNode* nodes, std::size_t count, double* values) noexcept;

}  // namespace omentum::physics::kernels
