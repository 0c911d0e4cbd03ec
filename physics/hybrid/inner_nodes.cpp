#include "physics/hybrid/inner_nodes.h"

#include <algorithm>

namespace omentum::physics {

namespace {

std::vector<bool> inner_of(const MeshPart& part, const geometry::Surface& surface) {
  std::vector<bool> is_inner(part.node.size(), true);
  for (const geometry::NodeId n : surface.node) is_inner[n] = false;
  return is_inner;
}

FixedComponents held_but(const std::vector<bool>& is_inner, FixedComponents fixed) {
  for (std::size_t n = 0; n < fixed.size(); ++n)
    if (!is_inner[n]) fixed[n] = kPinned;
  return fixed;
}

}  // namespace

InnerNodes::InnerNodes(const MeshPart& part, const geometry::Surface& surface, const FixedComponents& fixed,
                       const MaterialMap& material, std::span<const double> weights)
    : part_(part),
      is_inner_(inner_of(part, surface)),
      factor_(part.mesh, material, held_but(is_inner_, fixed), std::vector<double>(part.node.size(), 0.0),
              {.mass = 0, .stiffness = 1}, 0),
      own_(3 * part.node.size()),
      lacking_(own_.size()) {
  for (const geometry::NodeId n : part.node)
    for (std::size_t i = 0; i < 3; ++i) weights_.push_back(weights[3 * static_cast<std::size_t>(n) + i]);
}

void InnerNodes::follow(std::span<double> u) noexcept {
  for (std::size_t n = 0; n < part_.node.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i)
      own_[3 * n + i] = is_inner_[n] ? 0.0 : u[3 * static_cast<std::size_t>(part_.node[n]) + i];
  factor_.holding_forces(own_, lacking_);
  for (std::size_t c = 0; c < own_.size(); ++c) lacking_[c] = weights_[c] - lacking_[c];
  factor_.solve(lacking_, own_);
  for (std::size_t n = 0; n < part_.node.size(); ++n)
    if (is_inner_[n])
      std::copy_n(own_.data() + 3 * n, 3, u.data() + 3 * static_cast<std::size_t>(part_.node[n]));
}

}  // namespace omentum::physics
