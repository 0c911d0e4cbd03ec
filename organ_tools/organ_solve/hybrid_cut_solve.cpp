#include "organ_tools/organ_solve/hybrid_cut_solve.h"

#include "organ_tools/organ_solve/move_to_rest.h"
#include "physics/hybrid/hybrid_cut_step.h"

#include <algorithm>

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::TetId;
using geometry::Vec3;

physics::HybridTissue tissue_of(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed) {
  physics::Inertia inertia{physics::lumped_masses(organ.mesh, organ.material), cut.fixed};
  for (const physics::ImposedDisplacement& i : imposed) inertia.fixed[i.node] = physics::kPinned;
  return {organ.mesh, organ.material, std::move(inertia), organ.split->precomputed()};
}

}  // namespace

bool cuts_precomputed(const organ::Organ& organ, const CutOrgan& cut) {
  const auto is_precomputed = [&](TetId t) { return organ.split->dynamic[t] == 0; };
  return organ.split && std::ranges::any_of(cut.removed, is_precomputed);
}

physics::StaticSolution solve_hybrid_cut(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed,
                                         const Vec3& gravity, DynamicLaw law) {
  if (law != DynamicLaw::kLinear)
    throw InputError(
        "--law corotational: --remove names tetrahedra of the precomputed part; expected those of "
        "the dynamic part, or the linear law");
  if (organ.split->tie)
    throw InputError(
        "--remove: names tetrahedra of the precomputed part, which shares no nodes with the dynamic one; "
        "expected those of the dynamic part");
  physics::HybridCutStep step(tissue_of(organ, cut, imposed), kRestStep_s, 0);
  if (!step.remove(cut.removed))
    throw InputError("--remove: what is left hangs together too loosely to be solved");
  const std::vector<Vec3> weights = weights_of(organ, cut, gravity);
  std::vector<double> external;
  for (const Vec3& w : weights) external.insert(external.end(), w.begin(), w.end());
  physics::BodyState state = physics::state_at_rest(weights.size());
  for (const physics::ImposedDisplacement& i : imposed)
    Vec3::Map(&state.u[3 * static_cast<std::size_t>(i.node)]) = i.displacement;
  if (!run_to_rest([&] { return step.step(state, external); }, state))
    throw InputError("--model hybrid: found no rest; expected smaller loads or displacements");
  physics::StaticSolution solution;
  for (std::size_t n = 0; n < weights.size(); ++n)
    solution.displacements.emplace_back(state.u.data() + 3 * n);
  const std::vector<Vec3> forces = physics::holding_forces(stiffness_of(organ, cut), solution.displacements);
  for (const physics::ImposedDisplacement& i : imposed)
    solution.holding_forces.emplace_back(forces[i.node] - weights[i.node]);
  return solution;
}

}  // namespace omentum::organ_tools
