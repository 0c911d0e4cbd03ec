#include "physics/static_factor.h"

namespace omentum::physics {

using geometry::NodeId;
using geometry::TetId;

namespace {

const geometry::TetraMesh& held(const geometry::TetraMesh& mesh, const FixedComponents& fixed) {
  require_held(mesh, fixed);
  return mesh;
}

}  // namespace

StaticFactor::StaticFactor(const geometry::TetraMesh& mesh, const MaterialMap& material,
                           const FixedComponents& fixed, int most_compliance_nodes)
    : parting_(held(mesh, fixed)),
      anchor_n_m_(anchor_stiffness(mesh, material)),
      kept_(mesh, material, fixed, std::vector<double>(mesh.positions.size()), {1, 1}, most_compliance_nodes),
      residual_(3 * mesh.positions.size()),
      correction_(residual_.size()) {}

bool StaticFactor::remove(std::span<const TetId> tetrahedra) noexcept {
  const PartedTetrahedra parted = parting_.part(tetrahedra);
  // anchors first: then nothing on the way is singular
  const bool is_anchored = kept_.add_mass(parted.loose, anchor_n_m_);
  return kept_.remove(parted.taken) && is_anchored;
}

bool StaticFactor::hold(std::span<const NodeId> nodes) noexcept {
  parting_.settle(nodes);
  return kept_.add_mass(nodes, anchor_n_m_);
}

void StaticFactor::solve_exactly(std::span<const double> f, std::span<double> u) noexcept {
  kept_.solve(f, u);
  kept_.multiply(u, residual_);
  for (std::size_t c = 0; c < f.size(); ++c) residual_[c] = is_held(c) ? 0 : f[c] - residual_[c];
  kept_.solve(residual_, correction_);
  for (std::size_t c = 0; c < f.size(); ++c) u[c] += correction_[c];
}

void StaticFactor::restore() noexcept {
  kept_.restore();
  parting_.restore();
}

}  // namespace omentum::physics
