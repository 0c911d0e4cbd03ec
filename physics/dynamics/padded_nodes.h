// Three components of each node as vector units like them. No inline functions: kernel files include it.
#pragma once

#include <cstdint>
#include <span>

namespace omentum::physics::kernels {

/// x y z of a node, and nothing: one aligned load.
struct alignas(32) PaddedNode {
  double v[4];
};

/// values[3 N] into nodes[N]; the fourth of each is left as it is.
void pad(std::span<const double> values, PaddedNode* nodes) noexcept;

/// nodes[N] into values[3 N].
void unpad(const PaddedNode* nodes, std::span<double> values) noexcept;

}  // namespace omentum::physics::kernels
