#include "physics/direct_solve.h"

namespace omentum::physics {

namespace {

// Over the free degrees of freedom: loads minus what the displacements prescribed so far already call for.
Eigen::VectorXd right_hand_side(const Stiffness& stiffness, const FreeDofs& free,
                                std::span<const Vec3> prescribed, std::span<const Vec3> loads) {
  const std::vector<Vec3> called_for = holding_forces(stiffness, prescribed);
  Eigen::VectorXd f(free.count);
  for (std::int32_t n = 0; n < stiffness.node_count(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t dof = free.of(NodeId(n), axis);
      if (dof >= 0) f[dof] = (loads.empty() ? 0.0 : loads[n][axis]) - called_for[n][axis];
    }
  }
  return f;
}

}  // namespace

StaticSolution direct_solve(const Stiffness& stiffness, const FixedComponents& fixed,
                            std::span<const ImposedDisplacement> imposed, std::span<const Vec3> loads) {
  StaticSolution solution;
  solution.displacements.assign(stiffness.node_count(), Vec3::Zero());
  FixedComponents held = fixed;
  for (const ImposedDisplacement& i : imposed) {
    solution.displacements[i.node] = i.displacement;
    held[i.node] = kPinned;
  }

  const FreeDofs free = free_dofs(held);
  if (free.count > 0) {
    const StiffnessFactor factor(stiffness, free);
    const Eigen::VectorXd u = factor.solve(right_hand_side(stiffness, free, solution.displacements, loads));
    for (std::int32_t n = 0; n < stiffness.node_count(); ++n) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t dof = free.of(NodeId(n), axis);
        if (dof >= 0) solution.displacements[n][axis] = u[dof];
      }
    }
  }

  const std::vector<Vec3> forces = holding_forces(stiffness, solution.displacements);
  for (const ImposedDisplacement& i : imposed) {
    Vec3 r = forces[i.node] - (loads.empty() ? Vec3::Zero() : loads[i.node]);
    for (int axis = 0; axis < 3; ++axis) {
      if (is_fixed(fixed[i.node], axis)) r[axis] = 0;
    }
    solution.holding_forces.push_back(r);
  }
  return solution;
}

}  // namespace omentum::physics
