#include "organ_tools/tissue_compare/realism_trials.h"

#include "organ_tools/tissue_compare/equilibrium.h"

#include <functional>

namespace omentum::tissue_compare {

namespace {

using geometry::NodeId;
using geometry::Vec3;
using Vector = Eigen::VectorXd;

constexpr double kStrain = 1e-4;  // of the trials: laws differ from linear ones by as much
constexpr double kDifferenceOverCube =
    1e-4;  // the step of differences: forces of 1e-16 relative, laws smooth

struct Imposed {
  std::vector<std::uint8_t> held;  // [3N]
  Vector u;                        // [3N], m
};

Imposed nothing_imposed(const Beam& beam) {
  const std::size_t size = 3 * beam.tissue.mesh.positions.size();
  return {std::vector<std::uint8_t>(size, 0), Vector::Zero(static_cast<Eigen::Index>(size))};
}

void hold(Imposed& imposed, NodeId node, int axis) {
  imposed.held[static_cast<std::size_t>(3 * node + axis)] = 1;
}

// The ends go along x as `along` says and may slide in their planes; sides are free. What is left, two
// translations and a turn about x, is held at two nodes, where the solution has no force.
Imposed impose_ends(const Beam& beam, const std::function<double(const Vec3&)>& along) {
  Imposed imposed = nothing_imposed(beam);
  const auto& positions = beam.tissue.mesh.positions;
  for (std::size_t n = 0; n < positions.size(); ++n) {
    if (!beam.at_end(NodeId(n))) continue;
    hold(imposed, NodeId(n), 0);
    imposed.u[3 * static_cast<Eigen::Index>(n)] = along(positions[n]);
  }
  const NodeId first(std::size_t{0}), above(static_cast<std::int32_t>(positions.size()) - 1);
  hold(imposed, first, 1);
  hold(imposed, first, 2);
  hold(imposed, above, 2);
  return imposed;
}

Imposed impose_shear(const Beam& beam) {
  Imposed imposed = nothing_imposed(beam);
  for (std::size_t n = 0; n < beam.tissue.mesh.positions.size(); ++n) {
    if (!beam.on_surface(NodeId(n))) continue;
    for (int axis = 0; axis < 3; ++axis) hold(imposed, NodeId(n), axis);
    imposed.u[3 * static_cast<Eigen::Index>(n)] = kStrain * beam.tissue.mesh.positions[n].y();
  }
  return imposed;
}

Imposed impose_compression(const Beam& beam) {
  return impose_ends(beam, [](const Vec3& p) { return -kStrain * p.x(); });
}

double energy_at_rest(physics::ForceLaw& law, const Beam& beam, Imposed imposed) {
  relax(law, imposed.held, kDifferenceOverCube * beam.cube, imposed.u);
  return law.energy({imposed.u.data(), imposed.held.size()});
}

double largest_force(physics::ForceLaw& law, const Tissue& tissue, const Eigen::Matrix3d& A) {
  const std::size_t size = 3 * tissue.mesh.positions.size();
  std::vector<double> u(size), f(size);
  for (std::size_t i = 0; i < size; i += 3) {
    const Vec3& p = tissue.mesh.positions[i / 3];
    Vec3::Map(&u[i]) = A * p - p;
  }
  law.forces(u, f);
  double largest = 0;
  for (std::size_t i = 0; i < size; i += 3) largest = std::max(largest, Vec3::Map(&f[i]).norm());
  return largest;
}

}  // namespace

ContinuumErrors errors_against_continuum(Law law, const Beam& beam) {
  const std::unique_ptr<physics::ForceLaw> model = make_exact_law(law, beam.tissue);
  const double E = beam.common.young_pa, mu = beam.common.mu();
  const double curvature = 2 * kStrain / beam.height;
  const double compressed = E * kStrain * kStrain * beam.volume() / 2;
  const double sheared = mu * kStrain * kStrain * beam.volume() / 2;
  const double bent = E * beam.second_moment() * curvature * curvature * beam.length() / 2;
  const Imposed bending =
      impose_ends(beam, [curvature](const Vec3& p) { return -curvature * p.x() * p.y(); });
  return {energy_at_rest(*model, beam, impose_compression(beam)) / compressed - 1,
          energy_at_rest(*model, beam, impose_shear(beam)) / sheared - 1,
          energy_at_rest(*model, beam, bending) / bent - 1};
}

// The force is twice the energy over the displacement.
double force_left_by_cut(Law law, const Beam& beam) {
  const std::unique_ptr<physics::ForceLaw> model = make_exact_law(law, beam.tissue);
  const double whole = energy_at_rest(*model, beam, impose_compression(beam));
  for (const geometry::TetId t : beam.slot()) model->remove(t);
  return energy_at_rest(*model, beam, impose_compression(beam)) / whole;
}

double force_of_quarter_turn(Law law, const Tissue& tissue) {
  const std::unique_ptr<physics::ForceLaw> model = make_exact_law(law, tissue);
  Eigen::Matrix3d turn, squeeze = Eigen::Matrix3d::Identity();
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  squeeze(0, 0) = 0.9;
  return largest_force(*model, tissue, turn) / largest_force(*model, tissue, squeeze);
}

}  // namespace omentum::tissue_compare
