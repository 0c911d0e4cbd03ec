#include "deform_node/dynamic_maker.h"

#include "deform_node/dynamic_model.h"
#include "deform_node/hybrid_gauge.h"
#include "deform_node/tear_limits.h"
#include "physics/dynamics/corotational.h"
#include "physics/dynamics/spring_mesh.h"
#include "physics/dynamics/stable_step.h"
#include "physics/dynamics/tensor_mass.h"
#include "physics/hybrid/hybrid_cut_step.h"

#include <cstdio>
#include <utility>

namespace omentum::deform {

namespace {

using physics::StressLaw;

// One in each tick at deform_node's own rate: a hand goes by a local model until the next one comes, and that
// is good for one step. With two in a tick it met a plate of 1 cm too stiff, and was fed energy.
constexpr double kImplicitStep_s = 0.01;
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

struct Stepping {
  std::unique_ptr<BodyStepper> stepper;
  double energy_margin = 2;  // backward Euler's: it loses energy
  bool is_static = false;
};

// By the scene's own step, or a share of what the mesh allows.
Stepping step_explicitly(const SteppedBody& body, const scene::DynamicsSpec& dynamics,
                         physics::ExplicitScheme scheme, std::unique_ptr<physics::ForceLaw> law,
                         bool is_linear_at_rest = true) {
  const double highest_rad_s = physics::highest_frequency(*law, body.inertia).rad_s;
  const double stable_s = physics::stable_step_s(scheme, body.inertia, highest_rad_s);
  const double step_s = dynamics.step_s.value_or(kShareOfStable * stable_s);
  if (step_s > 0 && step_s < stable_s)
    return {make_explicit_stepper(body, std::move(law), scheme, step_s, is_linear_at_rest),
            physics::energy_margin(scheme, step_s / stable_s)};
  char line[160];
  std::snprintf(line, sizeof line,
                ": step_s: found %g, expected less than %.3g: below that \"%s\" is stable on this mesh",
                step_s, stable_s, dynamics.integrator.c_str());
  throw std::runtime_error(dynamics.where + line);
}

// `step`: of a body, by what its scene says; `stress`: what that body's law says.
template <class Step>
DynamicParts parts_of(const node::OrganSource& source, const scene::OrganSpec& spec,
                      physics::StressLaw stress, Step&& step) {
  const organ::Organ& organ = source.organ;
  const scene::DynamicsSpec& dynamics = *spec.dynamics;
  DynamicParts parts{.body = {organ.mesh, organ.material, inertia_of(organ, dynamics)},
                     .uncut_surface = organ.surface.node};
  Stepping stepping = step(parts.body, dynamics);
  parts.stepper = std::move(stepping.stepper);
  parts.energy_margin = stepping.energy_margin;
  parts.is_static = stepping.is_static;
  if (dynamics.pieces == "fall") parts.piece_gravity_m_s2 = dynamics.piece_gravity_m_s2;
  parts.gravity_m_s2 = dynamics.gravity_m_s2;
  parts.tears = tear_limits_of(organ, spec);
  parts.cut_delay_s = dynamics.cut_delay_s;
  parts.cut_rate_per_s = dynamics.cut_rate_per_s;
  parts.smallest_piece_m3 = dynamics.smallest_piece_m3;
  parts.stress = stress;
  return parts;
}

template <class Step>
std::unique_ptr<OrganModel> make(const node::OrganSource& source, const scene::OrganSpec& spec,
                                 physics::StressLaw stress, Step&& step) {
  if (source.organ.split && source.organ.split->tie) {
    throw std::runtime_error(spec.dynamics->where + ": organ " + spec.name +
                             ": its parts share no nodes; expected the model \"hybrid\"");
  }
  return std::make_unique<DynamicModel>(parts_of(source, spec, stress, std::forward<Step>(step)));
}

std::vector<double> components_of(std::span<const Vec3> vectors) {
  std::vector<double> components;
  for (const Vec3& v : vectors) components.insert(components.end(), v.begin(), v.end());
  return components;
}

// What has no mass and never tears: [T].
std::vector<std::uint8_t> set_precomputed(const organ::OrganSplit& split, DynamicParts& parts) {
  std::vector<std::uint8_t> precomputed = split.precomputed();
  parts.covered = split.covered;
  parts.body.inertia.mass =
      physics::masses_of_dynamic(parts.body.mesh, std::move(parts.body.inertia.mass), precomputed);
  for (std::size_t t = 0; t < parts.tears.size(); ++t)
    if (precomputed[t] != 0) parts.tears[t] = {};
  return precomputed;
}

physics::DynamicLaw law_of(const scene::OrganSpec& spec) {
  return spec.dynamics->law == "corotational" ? physics::DynamicLaw::kCorotational
                                              : physics::DynamicLaw::kLinear;
}

StressLaw stress_of(physics::DynamicLaw law) {
  return law == physics::DynamicLaw::kCorotational ? StressLaw::kTurned : StressLaw::kLinear;
}

template <class Law>
std::unique_ptr<physics::ForceLaw> law_of(const SteppedBody& body) {
  return std::make_unique<Law>(body.mesh, body.material);
}

}  // namespace

std::unique_ptr<OrganModel> make_tensor_mass(const node::OrganSource& source, const scene::OrganSpec& spec) {
  return make(source, spec, StressLaw::kLinear,
              [](const SteppedBody& body, const scene::DynamicsSpec& dynamics) -> Stepping {
                if (const auto scheme = scheme_of(dynamics.integrator))
                  return step_explicitly(body, dynamics, *scheme, law_of<physics::TensorMass>(body));
                return {make_implicit_stepper(body, dynamics.step_s.value_or(kImplicitStep_s))};
              });
}

std::unique_ptr<OrganModel> make_corotational(const node::OrganSource& source, const scene::OrganSpec& spec) {
  return make(source, spec, StressLaw::kTurned,
              [](const SteppedBody& body, const scene::DynamicsSpec& dynamics) -> Stepping {
                if (const auto scheme = scheme_of(dynamics.integrator))
                  return step_explicitly(body, dynamics, *scheme, law_of<physics::Corotational>(body));
                return {make_warped_stepper(body, dynamics.step_s.value_or(kImplicitStep_s))};
              });
}

std::unique_ptr<OrganModel> make_quasi_static_cut(const node::OrganSource& source,
                                                  const scene::OrganSpec& spec) {
  // a piece that turns as it falls has no stress of its turning
  const bool falls = spec.dynamics->pieces == "fall";
  return make(source, spec, falls ? StressLaw::kTurned : StressLaw::kLinear,
              [falls](const SteppedBody& body, const scene::DynamicsSpec&) -> Stepping {
                const auto loose = falls ? LoosePieces::kFall : LoosePieces::kDrop;
                return {.stepper = make_static_stepper(body, kImplicitStep_s, loose), .is_static = true};
              });
}

std::unique_ptr<OrganModel> make_spring_mass(const node::OrganSource& source, const scene::OrganSpec& spec) {
  return make(source, spec, StressLaw::kNone,
              [](const SteppedBody& body, const scene::DynamicsSpec& dynamics) {
                return step_explicitly(body, dynamics, scheme_of(dynamics.integrator).value(),
                                       law_of<physics::SpringMesh>(body), false);
              });
}

std::unique_ptr<OrganModel> make_hybrid(const node::OrganSource& source, const scene::OrganSpec& spec) {
  const organ::Organ& organ = source.organ;
  const organ::OrganSplit& split = *organ.split;
  const std::vector<double> weights =
      components_of(physics::body_forces(organ.mesh, organ.material, spec.dynamics->gravity_m_s2));
  const physics::DynamicLaw law = law_of(spec);
  const StressLaw stress = stress_of(law);
  DynamicParts parts =
      parts_of(source, spec, stress, [&](const SteppedBody& body, const scene::DynamicsSpec& dynamics) {
        auto step = std::make_unique<physics::HybridStep>(
            physics::HybridBody{split.parts, split.surface, *split.compliance, organ.material, split.fixed,
                                body.inertia, weights, law, split.tie ? &*split.tie : nullptr},
            dynamics.step_s.value_or(kImplicitStep_s), BodyStepper::kPatchNodes);
        return Stepping{make_large_stepper(organ.mesh.positions.size(), std::move(step))};
      });
  parts.precomputed = set_precomputed(split, parts);
  parts.gauge = [&organ, weights, stress] { return std::make_unique<HybridGauge>(organ, weights, stress); };
  return std::make_unique<DynamicModel>(std::move(parts));
}

std::unique_ptr<OrganModel> make_hybrid_cut(const node::OrganSource& source, const scene::OrganSpec& spec) {
  const organ::Organ& organ = source.organ;
  if (!organ.split)
    throw geometry::InputError("organ \"" + spec.name +
                               "\": its file has no dynamic part; model \"hybrid-cut\" expects a hybrid "
                               "organ (organ_build --dynamic)");
  if (organ.split->tie)
    throw geometry::InputError(
        "organ \"" + spec.name +
        "\": its parts share no nodes; model \"hybrid-cut\" expects parts of one mesh");
  const physics::DynamicLaw law = law_of(spec);
  DynamicParts parts = parts_of(
      source, spec, stress_of(law), [&](const SteppedBody& body, const scene::DynamicsSpec& dynamics) {
        auto step = std::make_unique<physics::HybridCutStep>(
            physics::HybridTissue{body.mesh, body.material, body.inertia, organ.split->precomputed(), law},
            dynamics.step_s.value_or(kImplicitStep_s), BodyStepper::kPatchNodes);
        return Stepping{make_large_stepper(organ.mesh.positions.size(), std::move(step))};
      });
  parts.massless = set_precomputed(*organ.split, parts);
  if (parts.piece_gravity_m_s2) parts.piece_gravity_m_s2 = parts.gravity_m_s2;
  return std::make_unique<DynamicModel>(std::move(parts));
}

}  // namespace omentum::deform
