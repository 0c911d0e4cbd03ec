#include "physics/dynamics/body_state.h"

#include "physics/element_tensors.h"

namespace omentum::physics {

BodyState state_at_rest(std::size_t node_count) {
  return {std::vector<double>(3 * node_count, 0), std::vector<double>(3 * node_count, 0)};
}

std::vector<double> lumped_masses(const geometry::TetraMesh& mesh, const MaterialMap& material) {
  std::vector<double> mass(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const geometry::TetId id(t);
    const Corners c = corners_of(mesh, id);
    const double own = material.of(mesh, id).density_kg_m3 * geometry::signed_volume(c[0], c[1], c[2], c[3]);
    for (const NodeId n : mesh.tetrahedra[t]) mass[n] += own / 4;
  }
  return mass;
}

double kinetic_energy(std::span<const double> mass, std::span<const double> v) noexcept {
  double twice = 0;
  for (std::size_t n = 0; n < mass.size(); ++n) {
    const double* w = &v[3 * n];
    twice += mass[n] * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  }
  return twice / 2;
}

}  // namespace omentum::physics
