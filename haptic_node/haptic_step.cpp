#include "haptic_node/haptic_step.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/contact_work.h"
#include "haptic_node/lost_contact.h"
#include "haptic_node/node_forces.h"
#include "haptic_node/other_tools.h"
#include "haptic_node/point_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::haptic {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// d: all of the gap where the tissue sticks (friction, grasp), its normal part where it slides freely.
SpreadContact spread_of(const HapticModel& model, HapticWorkspace& work, const ToolContact& contact,
                        const Vec3& gap) {
  SpreadContact spread;
  const geometry::Triangle& t = model.surface.triangles[contact.held.triangle];
  const Vec3 alpha = spread_weights(contact.held.barycentric);
  for (int v = 0; v < 3; ++v) {
    if (t[v] >= model.surface.mobile_count) continue;
    spread.slot[spread.count] = work.nodes.slot_of(t[v]);
    spread.alpha[spread.count++] = alpha[v];
  }
  const bool sticks = contact.grasped || model.friction > 0;
  spread.displacement = sticks ? gap : Vec3(gap.dot(contact.normal) * contact.normal);
  spread.normal = contact.normal;
  spread.may_pull = contact.grasped;
  return spread;
}

void solve_spread_contacts(const HapticModel& model, HapticState& state, HapticWorkspace& work) {
  std::array<SpreadContact, physics::kMaxContacts> spreads;
  std::array<SpreadForce, ContactNodes::kSlots> solved;
  const std::span<ToolContact> contacts = state.active();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    spreads[i] = spread_of(model, work, contacts[i], work.free_gaps[i]);
    contacts[i].force.setZero();
    contacts[i].sliding = false;
  }
  const int count = solve_spread(work.nodes, {spreads.data(), contacts.size()}, work.spread, solved);
  for (int a = 0; a < count; ++a) {
    ToolContact& contact = contacts[solved[a].contact];
    contact.force += solved[a].force;
    add_node_force(state, work.nodes.node_at(solved[a].slot), contact.tool, solved[a].force);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    work.gaps[i] = contacts[i].touches() ? Vec3::Zero() : spreads[i].displacement;
  }
}

void measure(std::span<const ToolInput> inputs, const HapticState& state, std::span<ToolOutput> outputs) {
  for (std::size_t t = 0; t < outputs.size(); ++t) {
    const ContactEnergy& energy = state.energies[t];
    outputs[t] = {};
    outputs[t].grasping = state.tools[t].grasping;
    outputs[t].grasp_count = state.tools[t].grasp_count;
    outputs[t].share = energy.share;
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
  std::array<double, DeformedSurface::kMaxForces> push;
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
  work.nodes.begin_tick();
  place_tools(model, inputs, state, work.surface);
  evaluate_neighbourhood(state, work.surface);
  leave_astray(state, work.surface);
  follow_surface(model, state, work.surface);
  meet_appeared(state, work.surface);
  find_contacts(state, work.surface);
  result.neighbourhood = work.surface.evaluated_nodes();

  state.node_force_count = 0;
  const int near = set_open_aside(state, work.surface);
  for (int i = 0; i < state.contact_count; ++i) {
    work.before[i] = state.contacts[i].force;
    work.free_gaps[i] = free_gap(state, state.contacts[i], work.surface);
  }
  if (model.mode == ContactMode::kPoint) {
    const physics::ContactSolution solution = solve_point_contacts(model, inputs, near, state, work);
    result.status = solution.status;
    result.residual_m = solution.residual_m;
    measure_other_tools(model, state, work);
  } else {
    solve_spread_contacts(model, state, work);
    propose_forces(state, work.surface);
  }
  if (is_finite(result, state)) {
    measure_work(model, state, work.before, work.free_gaps, work.gaps, work.works);
    if (model.mode == ContactMode::kPoint) measure_exchange(work.problem, state, work.before, work.works);
    balance(state.energies, work.works, anyone_let_go(state));
    measure(inputs, state, outputs);
  } else {
    result.status = physics::ContactStatus::kNotFinite;
    stop(state, outputs);
    propose_forces(state, work.surface);
  }
  for (const ToolOutput& output : outputs) result.contacts += output.touching;
  release_contacts(state, work.gaps);
  work.surface.accept();
  result.nodes = work.surface.loaded_nodes();
  answer_the_hands(state);
  return result;
}

Vec3 contact_displacement(SurfaceId node, const HapticState& state, HapticWorkspace& work) noexcept {
  const int n = work.nodes.slot_of(node);
  Vec3 u = Vec3::Zero();
  for (const NodeForce& entry : state.forces()) {
    const float* block = work.nodes.block(n, work.nodes.slot_of(entry.node));
    u += Eigen::Map<const Eigen::Matrix3f>(block).cast<double>() * entry.force;
  }
  return u;
}

}  // namespace omentum::haptic
