#include "organ_tools/tissue_compare/integrator_trials.h"

#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/stable_step.h"
#include "physics/dynamics/warped_step.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

namespace omentum::tissue_compare {

namespace {

using Clock = std::chrono::steady_clock;
using physics::ExplicitScheme;

constexpr int kRepeats = 15;            // of a force: what else the machine does costs some of them
constexpr double kShareOfStable = 0.9;  // of the stable step, computed at rest
constexpr std::size_t kFewestSteps = 20;
constexpr double kDisplacement = 1e-4;  // of the cost's trial over the organ's size
constexpr double kGravity = 9.81;       // m/s^2

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<double> small_displacements(const Tissue& tissue) {
  geometry::Vec3 low = tissue.mesh.positions[0], high = low;
  for (const geometry::Vec3& p : tissue.mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, kDisplacement * (high - low).maxCoeff());
  std::vector<double> u(3 * tissue.mesh.positions.size());
  std::ranges::generate(u, [&] { return normal(generator); });
  return u;
}

std::vector<double> weight(const physics::Inertia& inertia) {
  std::vector<double> force(3 * inertia.mass.size(), 0.0);
  for (std::size_t n = 0; n < inertia.mass.size(); ++n) force[3 * n + 1] = -kGravity * inertia.mass[n];
  return force;
}

bool is_sound(const physics::BodyState& state) {
  return std::ranges::all_of(state.u, [](double component) { return std::isfinite(component); });
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// Steps until the time is over or nothing is sound any more.
IntegratorTrial run(const std::string& scheme, double step_s, double trial_s, std::size_t nodes,
                    const std::function<void(physics::BodyState&)>& step) {
  physics::BodyState state = physics::state_at_rest(nodes);
  IntegratorTrial trial{scheme, step_s, 0, false};
  std::vector<double> seconds;
  const Clock::time_point start = Clock::now();
  while (seconds.size() < kFewestSteps || (!trial.diverged && seconds_since(start) < trial_s)) {
    const Clock::time_point begin = Clock::now();
    step(state);
    seconds.push_back(seconds_since(begin));
    trial.diverged = !is_sound(state);
  }
  trial.seconds = median(seconds);
  return trial;
}

IntegratorTrial run_explicit(ExplicitScheme scheme, physics::ForceLaw& law, const physics::Inertia& inertia,
                             double highest_rad_s, double trial_s) {
  const double step_s = kShareOfStable * physics::stable_step_s(scheme, inertia, highest_rad_s);
  if (!(step_s > 0)) return {physics::name_of(scheme), 0, 0, false};
  physics::ExplicitStep stepper(scheme, inertia);
  const std::vector<double> force = weight(inertia);
  return run(physics::name_of(scheme), step_s, trial_s, inertia.mass.size(),
             [&](physics::BodyState& state) { static_cast<void>(stepper.step(law, force, step_s, state)); });
}

// Whether a step under the tissue's weight was sound.
using ImplicitRunner = std::function<bool(physics::BodyState&)>;

ImplicitRunner implicit_runner(Law which, physics::ForceLaw& law, const Tissue& tissue,
                               const physics::Inertia& inertia, double step_s) {
  const std::vector<double> force = weight(inertia);
  if (which == Law::kCorotational) {
    const auto warped = std::make_shared<physics::WarpedStep>(
        tissue.mesh, tissue.material, inertia, physics::Corotational(tissue.mesh, tissue.material),
        physics::WarpedOptions{.step_s = step_s});
    return [warped, force](physics::BodyState& state) { return warped->step(state, force); };
  }
  const auto kept = std::make_shared<physics::ImplicitStep>(tissue.mesh, tissue.material, inertia,
                                                            physics::ImplicitOptions{.step_s = step_s});
  if (which == Law::kTensorMass)
    return [kept, force](physics::BodyState& state) { return kept->step(state, force); };
  return [kept, force, &law](physics::BodyState& state) { return kept->step(state, law, force); };
}

IntegratorTrial run_implicit(Law which, physics::ForceLaw& law, const Tissue& tissue,
                             const physics::Inertia& inertia, const IntegratorOptions& options) {
  const ImplicitRunner step = implicit_runner(which, law, tissue, inertia, options.implicit_step_s);
  bool sound = true;
  IntegratorTrial trial = run("implicit", options.implicit_step_s, options.trial_s, inertia.mass.size(),
                              [&](physics::BodyState& state) { sound = step(state) && sound; });
  trial.diverged = !sound;
  return trial;
}

}  // namespace

double force_seconds(Law law, const Tissue& tissue) {
  const std::unique_ptr<physics::ForceLaw> model = make_law(law, tissue);
  const std::vector<double> u = small_displacements(tissue);
  std::vector<double> f(u.size());
  double best = 1;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const Clock::time_point start = Clock::now();
    model->forces(u, f);
    best = std::min(best, seconds_since(start));
  }
  return best;
}

std::vector<IntegratorTrial> compare_integrators(Law law, const Tissue& tissue,
                                                 const IntegratorOptions& options) {
  const std::unique_ptr<physics::ForceLaw> model = make_law(law, tissue);
  physics::Inertia inertia;
  inertia.mass = physics::lumped_masses(tissue.mesh, tissue.material);
  inertia.fixed = options.fixed;
  const double highest = physics::highest_frequency(*model, inertia).rad_s;
  inertia.stiffness_damping_s = 2 * options.damping_ratio / highest;
  std::vector<IntegratorTrial> trials;
  for (const ExplicitScheme scheme : physics::kExplicitSchemes)
    trials.push_back(run_explicit(scheme, *model, inertia, highest, options.trial_s));
  trials.push_back(run_implicit(law, *model, tissue, inertia, options));
  return trials;
}

}  // namespace omentum::tissue_compare
