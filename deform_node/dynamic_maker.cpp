#include "deform_node/dynamic_maker.h"

#include "deform_node/dynamic_model.h"
#include "deform_node/tear_limits.h"
#include "physics/dynamics/corotational.h"
#include "physics/dynamics/spring_mesh.h"
#include "physics/dynamics/stable_step.h"
#include "physics/dynamics/tensor_mass.h"

#include <cstdio>
#include <utility>

namespace omentum::deform {

namespace {

// Half of what a picture of 100 Hz shows: an implicit step damps what is faster than itself.
constexpr double kImplicitStep_s = 0.005;
// Of the largest step that is stable: contacts and cuts come between.
constexpr double kShareOfStable = 0.5;

std::optional<physics::ExplicitScheme> scheme_of(const std::string& integrator) {
  if (integrator == "euler") return physics::ExplicitScheme::kForwardEuler;
  if (integrator == "symplectic") return physics::ExplicitScheme::kSymplecticEuler;
  if (integrator == "rk4") return physics::ExplicitScheme::kRungeKutta4;
  return {};
}

physics::Inertia inertia_of(const organ::Organ& organ, const scene::DynamicsSpec& dynamics) {
  return {.mass = physics::lumped_masses(organ.mesh, organ.material),
          .fixed = organ.fixed,
          .mass_damping_per_s = dynamics.mass_damping_per_s,
          .stiffness_damping_s = dynamics.stiffness_damping_s};
}

struct ExplicitTerms {
  double step_s, stable_s;
};

// The scene's own step, or a share of what the mesh allows.
ExplicitTerms explicit_terms(const scene::DynamicsSpec& dynamics, physics::ExplicitScheme scheme,
                             physics::ForceLaw& law, const physics::Inertia& inertia) {
  const double highest_rad_s = physics::highest_frequency(law, inertia).rad_s;
  const double stable_s = physics::stable_step_s(scheme, inertia, highest_rad_s);
  const double step_s = dynamics.step_s.value_or(kShareOfStable * stable_s);
  if (step_s > 0 && step_s < stable_s) return {step_s, stable_s};
  char line[160];
  std::snprintf(line, sizeof line,
                ": step_s: found %g, expected less than %.3g: \"%s\" is stable on this mesh below that",
                step_s, stable_s, dynamics.integrator.c_str());
  throw std::runtime_error(dynamics.where + line);
}

StepperParts stepper_of(const scene::DynamicsSpec& dynamics, const physics::Inertia& inertia,
                        std::unique_ptr<physics::ForceLaw> law) {
  StepperParts parts;
  parts.scheme = scheme_of(dynamics.integrator);
  parts.step_s = dynamics.step_s.value_or(kImplicitStep_s);
  if (parts.scheme) {
    const auto [step_s, stable_s] = explicit_terms(dynamics, *parts.scheme, *law, inertia);
    parts.step_s = step_s;
    parts.energy_margin = physics::energy_margin(*parts.scheme, step_s / stable_s);
  }
  parts.law = std::move(law);
  return parts;
}

// `law`: of an explicit scheme also where the kept factor knows the same forces.
std::unique_ptr<OrganModel> make(const node::OrganSource& source, const scene::OrganSpec& spec,
                                 std::unique_ptr<physics::ForceLaw> law) {
  const organ::Organ& organ = source.organ;
  const scene::DynamicsSpec& dynamics = *spec.dynamics;
  DynamicParts parts{.mesh = organ.mesh, .material = organ.material, .uncut_surface = organ.surface.node};
  parts.inertia = inertia_of(organ, dynamics);
  parts.stepper = stepper_of(dynamics, parts.inertia, std::move(law));
  parts.gravity_m_s2 = dynamics.gravity_m_s2;
  parts.tears = tear_limits_of(organ, spec);
  parts.cut_delay_s = dynamics.cut_delay_s;
  parts.cut_rate_per_s = dynamics.cut_rate_per_s;
  parts.smallest_piece_m3 = dynamics.smallest_piece_m3;
  return std::make_unique<DynamicModel>(std::move(parts));
}

template <class Law>
std::unique_ptr<physics::ForceLaw> law_of(const organ::Organ& organ) {
  return std::make_unique<Law>(organ.mesh, organ.material);
}

}  // namespace

std::unique_ptr<OrganModel> make_tensor_mass(const node::OrganSource& source, const scene::OrganSpec& spec) {
  // an implicit step has the same stiffness in its factor
  const bool needs_law = scheme_of(spec.dynamics->integrator).has_value();
  return make(source, spec, needs_law ? law_of<physics::TensorMass>(source.organ) : nullptr);
}

std::unique_ptr<OrganModel> make_corotational(const node::OrganSource& source, const scene::OrganSpec& spec) {
  return make(source, spec, law_of<physics::Corotational>(source.organ));
}

std::unique_ptr<OrganModel> make_spring_mass(const node::OrganSource& source, const scene::OrganSpec& spec) {
  return make(source, spec, law_of<physics::SpringMesh>(source.organ));
}

}  // namespace omentum::deform
