#include "organ_tools/organ_solve/move_to_rest.h"

#include "physics/dynamics/corotational.h"
#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/rest_search.h"
#include "physics/dynamics/spring_mesh.h"
#include "physics/dynamics/tensor_mass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace omentum::organ_tools {

namespace {

using geometry::InputError;
using geometry::Vec3;
using Law = std::unique_ptr<physics::ForceLaw>;

struct DynamicModel {
  std::string_view name;
  bool linear;  // its stiffness is the factor's, however far it moves
  Law (*make)(const organ::Organ&);
};

constexpr std::array kModels{
    DynamicModel{"tensor-mass", true,
                 [](const organ::Organ& organ) -> Law {
                   return std::make_unique<physics::TensorMass>(organ.mesh, organ.material,
                                                                physics::TensorMass::Arithmetic::kDouble);
                 }},
    DynamicModel{"corotational", false,
                 [](const organ::Organ& organ) -> Law {
                   return std::make_unique<physics::Corotational>(organ.mesh, organ.material);
                 }},
    DynamicModel{"spring-mass", false,
                 [](const organ::Organ& organ) -> Law {
                   return std::make_unique<physics::SpringMesh>(organ.mesh, organ.material);
                 }},
};

constexpr int kMostSteps = 5000;
// At rest: so many steps in a row move nothing farther than this part of the largest displacement.
constexpr int kQuietSteps = 3;
constexpr double kQuiet = 1e-11;

physics::Inertia inertia_of(const organ::Organ& organ, const CutOrgan& cut, Imposed imposed) {
  physics::Inertia inertia{physics::lumped_masses(organ.mesh, organ.material), cut.fixed};
  for (const physics::ImposedDisplacement& i : imposed) inertia.fixed[i.node] = physics::kPinned;
  return inertia;
}

physics::BodyState start_of(const organ::Organ& organ, Imposed imposed) {
  physics::BodyState state = physics::state_at_rest(organ.mesh.positions.size());
  for (const physics::ImposedDisplacement& i : imposed) {
    for (int axis = 0; axis < 3; ++axis) state.u[3 * i.node + axis] = i.displacement[axis];
  }
  return state;
}

double largest(std::span<const double> values) {
  double found = 0;
  for (const double value : values) found = std::max(found, std::abs(value));
  return found;
}

physics::StaticSolution solution_of(const physics::BodyState& state, std::span<const double> forces,
                                    std::span<const double> weight, Imposed imposed) {
  const auto at = [](std::span<const double> values, std::size_t n) {
    return Vec3(values[3 * n], values[3 * n + 1], values[3 * n + 2]);
  };
  physics::StaticSolution solution;
  for (std::size_t n = 0; n < state.u.size() / 3; ++n) solution.displacements.push_back(at(state.u, n));
  for (const physics::ImposedDisplacement& i : imposed) {
    const auto n = static_cast<std::size_t>(i.node);
    solution.holding_forces.emplace_back(-at(forces, n) - at(weight, n));
  }
  return solution;
}

}  // namespace

bool is_dynamic_model(std::string_view model) {
  return std::ranges::find(kModels, model, &DynamicModel::name) != kModels.end();
}

bool run_to_rest(const std::function<bool()>& step, const physics::BodyState& state) {
  int quiet = 0;
  for (int i = 0; i < kMostSteps && quiet < kQuietSteps; ++i) {
    if (!step()) return false;
    const bool moved = kRestStep_s * largest(state.v) > kQuiet * largest(state.u);
    quiet = moved ? 0 : quiet + 1;
  }
  return quiet == kQuietSteps;
}

physics::StaticSolution move_to_rest(std::string_view model, const organ::Organ& organ, const CutOrgan& cut,
                                     Imposed imposed, const Vec3& gravity) {
  const DynamicModel& dynamic = *std::ranges::find(kModels, model, &DynamicModel::name);
  const Law law = dynamic.make(organ);
  for (const geometry::TetId t : cut.removed) law->remove(t);
  const physics::Inertia inertia = inertia_of(organ, cut, imposed);
  physics::ImplicitStep stepper(organ.mesh, organ.material, inertia,
                                {.step_s = kRestStep_s, .most_compliance_nodes = 0});
  if (!stepper.remove(cut.removed))
    throw InputError("--remove: what is left hangs together too loosely to be solved");

  std::vector<double> weight;
  for (const Vec3& w : weights_of(organ, cut, gravity)) weight.insert(weight.end(), w.begin(), w.end());
  physics::BodyState state = start_of(organ, imposed);
  const bool rests = dynamic.linear ? run_to_rest([&] { return stepper.step(state, *law, weight); }, state)
                                    : physics::search_rest(*law, stepper.factor(), weight, state.u);
  if (!rests) {
    throw InputError("--model " + std::string(model) +
                     ": found no rest; expected smaller loads or displacements");
  }
  std::vector<double> forces(state.u.size());
  law->forces(state.u, forces);
  return solution_of(state, forces, weight, imposed);
}

}  // namespace omentum::organ_tools
