#include "organ_tools/organ_solve/tensor_error.h"

#include "physics/tensor_solve.h"

#include <algorithm>

namespace omentum::organ_tools {

namespace {

using geometry::SurfaceId;
using geometry::Vec3;

double largest(std::span<const Vec3> vectors) {
  double found = 0;
  for (const Vec3& v : vectors) found = std::max(found, v.cwiseAbs().maxCoeff());
  return found;
}

double fraction(double part, double whole) {
  return part > 0 ? part / whole : 0;
}

// K u - f, [N]: what holds the nodes there, supports included.
std::vector<Vec3> held_by(const physics::Stiffness& stiffness, std::span<const Vec3> displacements,
                          std::span<const Vec3> loads) {
  std::vector<Vec3> forces = physics::holding_forces(stiffness, displacements);
  for (std::size_t n = 0; n < loads.size(); ++n) forces[n] -= loads[n];
  return forces;
}

// r, [mobile]: zero at imposed nodes and in held components.
std::vector<Vec3> imbalance(const organ::Organ& organ, Imposed imposed, std::span<const Vec3> forces) {
  std::vector<Vec3> r(organ.surface.mobile_count, Vec3::Zero());
  for (std::size_t s = 0; s < r.size(); ++s) {
    const geometry::NodeId n = organ.surface.node[s];
    for (int axis = 0; axis < 3; ++axis) {
      if (!physics::is_fixed(organ.fixed[n], axis)) r[s][axis] = forces[n][axis];
    }
  }
  for (const physics::ImposedDisplacement& i : imposed) r[organ.surface.of_node[i.node]].setZero();
  return r;
}

// C r, [mobile]. Single precision is enough for what is a correction; its range might not be, so r is scaled.
std::vector<Vec3> superpose(const physics::SurfaceCompliance& compliance, std::vector<Vec3> r) {
  constexpr int kLanes = physics::SurfaceCompliance::kLanes;
  const double scale = largest(r);
  std::vector<Vec3> result(r.size(), Vec3::Zero());
  if (scale == 0) return result;
  std::vector<SurfaceId> nodes;
  for (std::size_t s = 0; s < r.size(); ++s) {
    nodes.emplace_back(s);
    r[s] /= scale;
  }
  std::vector<float> u(static_cast<std::size_t>(3 * kLanes) * compliance.cluster_count());
  physics::superpose_surface(compliance, nodes, r, u);
  for (std::size_t s = 0; s < r.size(); ++s) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[s][static_cast<Eigen::Index>(axis)] = scale * u[(s / kLanes * 3 + axis) * kLanes + s % kLanes];
  }
  return result;
}

bool any_partly_held(const organ::Organ& organ, Imposed imposed) {
  return std::ranges::any_of(imposed,
                             [&](const physics::ImposedDisplacement& i) { return organ.fixed[i.node] != 0; });
}

}  // namespace

TensorError measure_error(const organ::Organ& organ, const organ::StoredTensors& tensors,
                          const physics::Stiffness& stiffness, std::span<const Vec3> loads, Imposed imposed,
                          const physics::StaticSolution& solution) {
  const std::vector<Vec3> forces = held_by(stiffness, solution.displacements, loads);
  const std::vector<Vec3> C_r =
      superpose(organ::surface_compliance(tensors), imbalance(organ, imposed, forces));
  std::vector<physics::ImposedSurfaceNode> asked;
  for (const physics::ImposedDisplacement& i : imposed) {
    const SurfaceId s = organ.surface.of_node[i.node];
    asked.push_back({s, C_r[s]});
  }
  const physics::SurfaceSolution back =
      physics::tensor_solve(tensors.single, organ.surface, organ.fixed, asked);

  // where the exact answer lies: over the surface, and inside only where a support's share depends on it
  std::vector<Vec3> change(organ.mesh.positions.size(), Vec3::Zero());
  for (std::size_t s = 0; s < C_r.size(); ++s) change[organ.surface.node[s]] = back.displacements[s] - C_r[s];
  for (const physics::ImposedDisplacement& i : imposed) change[i.node].setZero();
  std::vector<Vec3> shares(forces.size(), Vec3::Zero());
  if (any_partly_held(organ, imposed)) {
    shares = physics::holding_forces(
        stiffness, physics::extend_inside(stiffness, organ.fixed, organ.surface, change, {}));
  }

  double off = 0;
  for (std::size_t i = 0; i < imposed.size(); ++i) {
    const geometry::NodeId n = imposed[i].node;
    for (int axis = 0; axis < 3; ++axis) {
      const bool held = physics::is_fixed(organ.fixed[n], axis);
      const double exact = forces[n][axis] + (held ? shares[n][axis] : back.holding_forces[i][axis]);
      off = std::max(off, std::abs(exact - solution.holding_forces[i][axis]));
    }
  }
  return {fraction(off, largest(solution.holding_forces)),
          fraction(largest(change), largest(solution.displacements))};
}

}  // namespace omentum::organ_tools
