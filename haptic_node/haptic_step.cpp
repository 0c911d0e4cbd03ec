#include "haptic_node/haptic_step.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/contact_work.h"
#include "haptic_node/lost_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::haptic {
namespace {

using Gaps = std::array<Vec3, physics::kMaxContacts>;
using Forces = std::array<Vec3, physics::kMaxContacts>;

// Of positions in float, m.
constexpr double kRounding_m = 2e-6;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// Of the first contacts, so many.
void pose_problem(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state, int count,
                  HapticWorkspace& work) {
  const std::span<const ToolContact> contacts = state.active().first(static_cast<std::size_t>(count));
  work.problem.count = count;
  work.problem.friction = model.friction;
  for (int i = 0; i < work.problem.count; ++i) {
    const ToolContact& contact = contacts[i];
    work.shares[i] = share_of(model.surface, contact.held, work.nodes);
    work.problem.contacts[i] = {contact.normal, free_gap(state, contact, work.surface), contact.grasped,
                                contact.tool, inputs[contact.tool].max_stiffness_n_m};
    for (int j = 0; j <= i; ++j) {
      work.problem.W(i, j) = contact_compliance(work.nodes, work.shares[i], work.shares[j]);
      if (j < i) work.problem.W(j, i) = work.problem.W(i, j).transpose();
    }
  }
  physics::limit_stiffness(work.problem);
}

Vec3 gap_of(const HapticWorkspace& work, std::span<const Vec3> forces, int i) {
  Vec3 gap = work.problem.contacts[i].free_gap - physics::kContactCompliance_m_n * forces[i];
  for (int j = 0; j < work.problem.count; ++j) gap -= work.problem.W(i, j) * forces[j];
  return gap;
}

// Adds a force on a node; the same node's from the same tool are one entry.
void add_node_force(HapticState& state, SurfaceId node, std::int32_t tool, const Vec3& force) {
  for (int q = 0; q < state.node_force_count; ++q) {
    NodeForce& entry = state.node_forces[q];
    if (entry.node == node && entry.tool == tool) {
      entry.force += force;
      return;
    }
  }
  state.node_forces[state.node_force_count++] = {node, tool, force};
}

// f_v = k_v lambda: the force at a material point is shared by its vertices.
void share_force(const HapticModel& model, HapticState& state, const ToolContact& contact) {
  const geometry::Triangle& t = model.surface.triangles[contact.held.triangle];
  for (int v = 0; v < 3; ++v) {
    const double k = contact.held.barycentric[v];
    if (t[v] < model.surface.mobile_count && k > 0)
      add_node_force(state, t[v], contact.tool, k * contact.force);
  }
}

void solve_points(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state, int count,
                  HapticWorkspace& work, StepResult& result, Gaps& gaps) {
  pose_problem(model, inputs, state, count, work);
  state.node_force_count = 0;
  Forces forces;
  const std::span<ToolContact> contacts = state.active().first(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < contacts.size(); ++i) forces[i] = contacts[i].force;
  const physics::ContactSolution solution = physics::solve_contacts(work.problem, forces, work.solver);
  result.status = solution.status;
  result.residual_m = solution.residual_m;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ToolContact& contact = contacts[i];
    contact.force = forces[i];
    gaps[i] = gap_of(work, forces, static_cast<int>(i));
    const Vec3 slip = gaps[i] - gaps[i].dot(contact.normal) * contact.normal;
    contact.sliding = slip.norm() > physics::kGapTolerance_m;
    if (contact.touches()) share_force(model, state, contact);
  }
}

// All tools' forces on a node together.
struct MergedForces {
  std::array<SurfaceId, DeformedSurface::kMaxForces> nodes;
  std::array<Vec3, DeformedSurface::kMaxForces> forces;
  std::size_t count = 0;

  explicit MergedForces(const HapticState& state) {
    for (const NodeForce& entry : state.forces()) {
      const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(count);
      const auto at = static_cast<std::size_t>(std::find(nodes.begin(), end, entry.node) - nodes.begin());
      if (at < count) {
        forces[at] += entry.force;
      } else {
        nodes[count] = entry.node;
        forces[count++] = entry.force;
      }
    }
  }
  std::span<const SurfaceId> at() const { return {nodes.data(), count}; }
  std::span<const Vec3> all() const { return {forces.data(), count}; }
};

// Whether one of the open contacts behind the first `count` may touch under the forces that were solved for.
bool may_close(const HapticState& state, int count, DeformedSurface& surface) {
  const MergedForces merged(state);
  const DeformedSurface::ForceChange change = surface.change_to(merged.at(), merged.all());
  return std::ranges::any_of(
      state.active().subspan(static_cast<std::size_t>(count)), [&](const auto& contact) {
        return -depth_of(state, contact, surface) <= surface.motion_bound(contact.held, change) + kRounding_m;
      });
}

// Solved without the contacts that stay open, which costs a fraction; with them where one may not.
void solve_near_points(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                       int count, std::span<const Vec3> before, HapticWorkspace& work, StepResult& result,
                       Gaps& gaps) {
  solve_points(model, inputs, state, count, work, result, gaps);
  if (count == state.contact_count) return;
  if (may_close(state, count, work.surface)) {
    for (int i = 0; i < count; ++i) state.contacts[i].force = before[i];
    solve_points(model, inputs, state, state.contact_count, work, result, gaps);
    return;
  }
  for (int i = count; i < state.contact_count; ++i) {
    ToolContact& contact = state.contacts[i];
    gaps[i] = -depth_of(state, contact, work.surface) * contact.normal;
    contact.sliding = false;
  }
}

// d: all of the gap where the tissue sticks (friction, grasp), its normal part where it slides freely.
SpreadContact spread_of(const HapticModel& model, HapticState& state, HapticWorkspace& work,
                        const ToolContact& contact) {
  SpreadContact spread;
  const geometry::Triangle& t = model.surface.triangles[contact.held.triangle];
  const Vec3 alpha = spread_weights(contact.held.barycentric);
  for (int v = 0; v < 3; ++v) {
    if (t[v] >= model.surface.mobile_count) continue;
    spread.slot[spread.count] = work.nodes.slot_of(t[v]);
    spread.alpha[spread.count++] = alpha[v];
  }
  const Vec3 gap = free_gap(state, contact, work.surface);
  const bool sticks = contact.grasped || model.friction > 0;
  spread.displacement = sticks ? gap : Vec3(gap.dot(contact.normal) * contact.normal);
  spread.normal = contact.normal;
  spread.may_pull = contact.grasped;
  return spread;
}

void solve_spread_contacts(const HapticModel& model, HapticState& state, HapticWorkspace& work, Gaps& gaps) {
  std::array<SpreadContact, physics::kMaxContacts> spreads;
  std::array<SpreadForce, ContactNodes::kSlots> solved;
  const std::span<ToolContact> contacts = state.active();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    spreads[i] = spread_of(model, state, work, contacts[i]);
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
    gaps[i] = contacts[i].touches() ? Vec3::Zero() : spreads[i].displacement;
  }
}

void measure(std::span<const ToolInput> inputs, const HapticState& state, std::span<ToolOutput> outputs) {
  for (std::size_t t = 0; t < outputs.size(); ++t) {
    const ContactEnergy& energy = state.energies[t];
    outputs[t] = {};
    outputs[t].grasping = state.tools[t].grasping;
    outputs[t].grasp_count = state.tools[t].grasp_count;
    outputs[t].share = energy.share;
    outputs[t].stored_j = energy.share * energy.stored_j;
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
  std::array<double, physics::kMaxContacts> pushes{};
  const std::span<NodeForce> forces(state.node_forces.data(),
                                    static_cast<std::size_t>(state.node_force_count));
  for (const NodeForce& entry : forces) pushes[entry.tool] += entry.force.norm();
  for (NodeForce& entry : forces) {
    const ContactEnergy& energy = state.energies[entry.tool];
    const double push = entry.force.norm();
    const double all = pushes[entry.tool];
    if (push > 0) entry.force = borne_share(energy) * entry.force - push / all * borne_side(energy, all);
  }
}

bool anyone_let_go(const HapticState& state) {
  return std::ranges::any_of(state.tools, [](const ToolState& tool) { return tool.let_go; });
}

// The surface of the next tick.
int hand_over_forces(const HapticState& state, DeformedSurface& surface) {
  const MergedForces merged(state);
  surface.set_forces(merged.at(), merged.all());
  return static_cast<int>(merged.count);
}

}  // namespace

StepResult haptic_step(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                       HapticWorkspace& work, std::span<ToolOutput> outputs) noexcept {
  StepResult result;
  Gaps free_gaps, gaps;
  Forces before;
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
    before[i] = state.contacts[i].force;
    free_gaps[i] = free_gap(state, state.contacts[i], work.surface);
  }
  if (model.mode == ContactMode::kPoint) {
    solve_near_points(model, inputs, state, near, before, work, result, gaps);
  } else {
    solve_spread_contacts(model, state, work, gaps);
  }
  if (is_finite(result, state)) {
    measure_work(model, state, before, free_gaps, gaps, work.works);
    if (model.mode == ContactMode::kPoint) measure_exchange(work.problem, state, before, work.works);
    balance(state.energies, work.works, anyone_let_go(state));
    measure(inputs, state, outputs);
  } else {
    result.status = physics::ContactStatus::kNotFinite;
    stop(state, outputs);
  }
  for (const ToolOutput& output : outputs) result.contacts += output.touching;
  release_contacts(state, {gaps.data(), static_cast<std::size_t>(state.contact_count)});
  result.nodes = hand_over_forces(state, work.surface);
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
