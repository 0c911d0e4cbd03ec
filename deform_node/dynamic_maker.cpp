#include "deform_node/dynamic_maker.h"

#include "deform_node/dynamic_model.h"
#include "deform_node/tear_limits.h"

#include <utility>

namespace omentum::deform {

namespace {

// Half of what a picture of 100 Hz shows: an implicit step damps what is faster than itself.
constexpr double kImplicitStep_s = 0.005;

std::unique_ptr<OrganModel> make(const node::OrganSource& source, const scene::OrganSpec& spec,
                                 std::unique_ptr<physics::ForceLaw> law) {
  const organ::Organ& organ = source.organ;
  const scene::DynamicsSpec& dynamics = *spec.dynamics;
  return std::make_unique<DynamicModel>(
      DynamicParts{.mesh = organ.mesh,
                   .material = organ.material,
                   .uncut_surface = organ.surface.node,
                   .inertia = {.mass = physics::lumped_masses(organ.mesh, organ.material),
                               .fixed = organ.fixed,
                               .mass_damping_per_s = dynamics.mass_damping_per_s,
                               .stiffness_damping_s = dynamics.stiffness_damping_s},
                   .stepper = {.law = std::move(law), .step_s = dynamics.step_s.value_or(kImplicitStep_s)},
                   .gravity_m_s2 = dynamics.gravity_m_s2,
                   .tears = tear_limits_of(organ, spec),
                   .cut_delay_s = dynamics.cut_delay_s,
                   .cut_rate_per_s = dynamics.cut_rate_per_s,
                   .smallest_piece_m3 = dynamics.smallest_piece_m3};
  return std::make_unique<DynamicModel>(std::move(parts));
}

}  // namespace

std::unique_ptr<OrganModel> make_tensor_mass(const node::OrganSource& source, const scene::OrganSpec& spec) {
  return make(source, spec, nullptr);
}

}  // namespace omentum::deform
