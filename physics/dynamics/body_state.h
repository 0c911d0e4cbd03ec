// What moves (state) and what stays (inertia, supports, damping) of a body that swings.
#pragma once

#include "physics/material_map.h"
#include "physics/supports.h"

#include <span>
#include <vector>

namespace omentum::physics {

/// [3 N] each, x y z of each node in the mesh's order.
struct BodyState {
  std::vector<double> u;  // displacement from rest, m
  std::vector<double> v;  // velocity, m/s
};

BodyState state_at_rest(std::size_t node_count);

/// The terms of M a = f(u) - D v + f_ext of the uncut body (what cuts leave of the mass: carried_mass.h;
/// under explicit schemes all of it stays on the nodes, or a step that was stable need not be). Damping is
/// Rayleigh's, D = a M + b K: the share of critical damping of a mode of angular frequency w is a / (2 w) + b
/// w / 2.
struct Inertia {
  std::vector<double> mass;        // [N], kg, above zero
  FixedComponents fixed;           // [N]
  double mass_damping_per_s = 0;   // a, 1/s: drag in proportion to mass; Cotin 1998's d is a times the mass
  double stiffness_damping_s = 0;  // b, s: viscosity in proportion to stiffness
};

/// A quarter of each tetrahedron's mass at each of its corners, [N], kg (Cotin 1998, section 5.2).
std::vector<double> lumped_masses(const geometry::TetraMesh& mesh, const MaterialMap& material);

/// v^T M v / 2, J.
double kinetic_energy(std::span<const double> mass, std::span<const double> v) noexcept;
inline double kinetic_energy(const Inertia& inertia, std::span<const double> v) noexcept {
  return kinetic_energy(inertia.mass, v);
}

}  // namespace omentum::physics
