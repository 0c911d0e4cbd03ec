#include "haptic_node/haptic_step.h"

#include "haptic_node/body_change.h"
#include "haptic_node/contact_list.h"
#include "haptic_node/contact_work.h"
#include "haptic_node/jaws.h"
#include "haptic_node/lost_contact.h"
#include "haptic_node/node_forces.h"
#include "haptic_node/other_tools.h"
#include "haptic_node/point_contacts.h"

#include <algorithm>
#include <limits>

namespace omentum::haptic {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// d: all of the gap where the tissue sticks (friction, grasp), its normal part where it slides freely.
SpreadContact spread_of(const HapticModel& model, Body& body, const ToolContact& contact, const Vec3& gap) {
  SpreadContact spread;
  const PointNodes& at = contact.place.nodes;
  for (int v = 0; v < at.count; ++v) {
    spread.slot[spread.count] = body.contact_nodes().slot_of(at.node[v]);
    spread.alpha[spread.count++] = spread_weight(at.weight[v], contact.held.barycentric);
  }
  const bool sticks = contact.grasped || model.friction > 0;
  spread.displacement = sticks ? gap : Vec3(gap.dot(contact.place.normal) * contact.place.normal);
  spread.normal = contact.place.normal;
  spread.may_pull = contact.grasped;
  return spread;
}

void solve_spread_contacts_of(BodyId id, Body& body, const HapticModel& model, HapticState& state,
                              HapticWorkspace& work) {
  std::array<SpreadContact, physics::kMaxContacts> spreads;
  std::array<int, physics::kMaxContacts> contact_of;
  std::array<SpreadForce, ContactNodes::kSlots> solved;
  std::size_t spread_count = 0;
  for (int i = 0; i < state.contact_count; ++i) {
    ToolContact& contact = state.contacts[i];
    if (contact.body != id) continue;
    contact_of[spread_count] = i;
    spreads[spread_count++] = spread_of(model, body, contact, work.free_gaps[i]);
    contact.force.setZero();
    contact.sliding = false;
  }
  const int count = solve_spread(body.contact_nodes(), {spreads.data(), spread_count}, work.spread, solved);
  for (int a = 0; a < count; ++a) {
    ToolContact& contact = state.contacts[contact_of[solved[a].contact]];
    contact.force += solved[a].force;
    add_node_force(state, id, body.contact_nodes().node_at(solved[a].slot), contact.tool, solved[a].force);
  }
  for (std::size_t s = 0; s < spread_count; ++s) {
    const int i = contact_of[s];
    work.gaps[i] = state.contacts[i].touches() ? Vec3::Zero() : spreads[s].displacement;
  }
}

void solve_spread_contacts(const HapticModel& model, HapticState& state, HapticWorkspace& work) {
  work.bodies.for_each(
      [&](BodyId id, Body& body) { solve_spread_contacts_of(id, body, model, state, work); });
  propose_forces(state, work.bodies);
}

void measure(const HapticModel& model, std::span<const ToolInput> inputs, const HapticState& state,
             std::span<ToolOutput> outputs) {
  for (std::size_t t = 0; t < outputs.size(); ++t) {
    const ContactEnergy& energy = state.energies[t];
    outputs[t] = {};
    outputs[t].grasping = state.tools[t].grasping;
    outputs[t].grasp_count = state.tools[t].grasp_count;
    outputs[t].share = energy.share;
    if (outputs[t].grasping) outputs[t].pull_n = energy.share * pull_n(state, static_cast<std::int32_t>(t));
    outputs[t].stored_j = std::max(0.0, energy.account_j);
    outputs[t].force = energy.side;
    if (inputs[t].engaged && !is_sound(inputs[t])) outputs[t].force.setConstant(kNoNumber);
  }
  for (int i = 0; i < state.contact_count; ++i) {
    const ToolContact& contact = state.contacts[i];
    if (!contact.touches()) continue;
    const ToolState& tool = state.tools[contact.tool];
    ToolOutput& output = outputs[contact.tool];
    const Vec3 felt = output.share * contact.force;
    ++output.touching;
    output.force -= felt;
    output.torque -= (tool.now[contact.point] - tool.frame.p_WT).cross(felt);
    output.grip_torque += grip_torque(model.tools[contact.tool], tool, contact, felt);
  }
}

bool is_finite(const StepResult& result, const HapticState& state) {
  return result.status != physics::ContactStatus::kNotFinite &&
         std::ranges::all_of(state.forces(), [](const NodeForce& entry) { return entry.force.allFinite(); });
}

// What is no number reaches neither the surface of the next tick nor the wire; the hands that held on to the
// tissue are told so, and their safety stops them.
void stop(HapticState& state, std::span<ToolOutput> outputs) {
  for (ToolOutput& output : outputs) output = {};
  for (const ToolContact& contact : state.active()) outputs[contact.tool].force.setConstant(kNoNumber);
  let_go_of_everything(state);
}

// What leaves is equal and opposite: on its nodes the tissue bears what the hands feel (but for presses of
// centimetres, see borne_share), the side force shared like the push. Collision goes on with the model's own
// dent, in which the tool's points lie on the surface.
void answer_the_hands(HapticState& state) {
  std::array<double, physics::kMaxContacts> all{};
  std::array<double, Body::kMaxForces> push;
  for (int q = 0; q < state.node_force_count; ++q) {
    const NodeForce& entry = state.node_forces[q];
    push[q] = entry.force.norm();
    all[entry.tool] += push[q];
  }
  for (int q = 0; q < state.node_force_count; ++q) {
    NodeForce& entry = state.node_forces[q];
    const ContactEnergy& energy = state.energies[entry.tool];
    const double tool_n = all[entry.tool];
    if (push[q] > 0)
      entry.force = borne_share(energy) * entry.force - push[q] / tool_n * borne_side(energy, tool_n);
  }
}

bool anyone_let_go(const HapticState& state) {
  return std::ranges::any_of(state.tools, [](const ToolState& tool) { return tool.let_go; });
}

}  // namespace

StepResult haptic_step(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                       HapticWorkspace& work, std::span<ToolOutput> outputs) noexcept {
  StepResult result;
  Bodies& bodies = work.bodies;
  bodies.for_each([](BodyId, Body& body) { body.contact_nodes().begin_tick(); });
  place_tools(model, inputs, state, bodies);
  bodies.for_each([&](BodyId, Body& body) { body.go_on(state.now_ns); });
  take_in_bodies(state, work);
  evaluate_neighbourhood(state, bodies);
  leave_astray(model, state, bodies);
  follow_surface(model, state, bodies);
  meet_appeared(state, bodies);
  find_contacts(state, bodies);
  bodies.for_each([&](BodyId, Body& body) { result.neighbourhood += body.evaluated_nodes(); });

  state.node_force_count = 0;
  const int near = set_open_aside(state);
  for (int i = 0; i < state.contact_count; ++i) {
    work.before[i] = state.contacts[i].force;
    work.free_gaps[i] = free_gap(state, state.contacts[i]);
  }
  if (model.mode == ContactMode::kPoint) {
    const physics::ContactSolution solution = solve_point_contacts(model, inputs, near, state, work);
    result.status = solution.status;
    result.residual_m = solution.residual_m;
    bodies.for_each([&](BodyId id, Body& body) { measure_other_tools(id, body, state); });
  } else {
    solve_spread_contacts(model, state, work);
  }
  if (is_finite(result, state)) {
    measure_work(model, state, work.before, work.free_gaps, work.gaps, work.works);
    if (model.mode == ContactMode::kPoint) measure_exchange(work.problem, state, work.before, work.works);
    settle_own_motion(state, work.works);
    for (std::size_t t = 0; t < inputs.size(); ++t) work.works[t].covered_j = inputs[t].covered_j;
    balance(state.energies, work.works, anyone_let_go(state));
    measure(model, inputs, state, outputs);
  } else {
    result.status = physics::ContactStatus::kNotFinite;
    stop(state, outputs);
    propose_forces(state, bodies);
  }
  for (const ToolOutput& output : outputs) result.contacts += output.touching;
  release_contacts(state, work.gaps);
  bodies.for_each([&](BodyId, Body& body) {
    body.accept();
    result.nodes += body.loaded_nodes();
  });
  answer_the_hands(state);
  return result;
}

Vec3 contact_displacement(BodyId body, SurfaceId node, const HapticState& state, Bodies& bodies) noexcept {
  ContactNodes& nodes = bodies[body].contact_nodes();
  const int n = nodes.slot_of(node);
  Vec3 u = bodies[body].moved_without_forces(node);
  for (const NodeForce& entry : state.forces()) {
    if (entry.body != body) continue;
    const float* block = nodes.block(n, nodes.slot_of(entry.node));
    u += Eigen::Map<const Eigen::Matrix3f>(block).cast<double>() * entry.force;
  }
  return u;
}

}  // namespace omentum::haptic
