#include "haptic_node/point_contacts.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/node_forces.h"
#include "haptic_node/other_tools.h"

namespace omentum::haptic {
namespace {

// Of positions in float, m.
constexpr double kRounding_m = 2e-6;

// f_v = k_v lambda: the force at a material point is shared by its vertices.
void share_force(const HapticModel& model, HapticState& state, const ToolContact& contact) {
  const geometry::Triangle& t = model.surface.triangles[contact.held.triangle];
  for (int v = 0; v < 3; ++v) {
    const double k = contact.held.barycentric[v];
    if (t[v] < model.surface.mobile_count && k > 0)
      add_node_force(state, t[v], contact.tool, k * contact.force);
  }
}

class PointContacts {
 public:
  PointContacts(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                HapticWorkspace& work)
      : model_(model),
        inputs_(inputs),
        state_(state),
        work_(work),
        problem_(work.problem),
        near_others_(any_near_others(state)) {
    problem_.count = 0;
    problem_.friction = model.friction;
  }

  physics::ContactSolution solve(int near) {
    const physics::ContactSolution solution = solve_first(near);
    return stay_open() ? solution : solve_first(state_.contact_count);
  }

 private:
  // Contact i against the first `columns` and itself.
  void pose(int i, int columns) {
    const ToolContact& contact = state_.contacts[i];
    work_.shares[i] = share_of(model_.surface, contact.held, work_.nodes);
    problem_.contacts[i] = {contact.normal, work_.free_gaps[i], contact.grasped, contact.tool,
                            inputs_[contact.tool].max_stiffness_n_m};
    for (int j = 0; j < columns; ++j) {
      find_compliance(work_.nodes, work_.shares[i], work_.shares[j], problem_.W(i, j));
      if (near_others_ && state_.contacts[j].tool != contact.tool)
        problem_.W(i, j).diagonal().array() -= own_compliance(work_.nodes, work_.shares[i], work_.shares[j]);
      problem_.W(j, i) = problem_.W(i, j).transpose();
    }
    find_compliance(work_.nodes, work_.shares[i], work_.shares[i], problem_.W(i, i));
    physics::limit_stiffness(problem_, i, columns);
  }

  physics::ContactSolution solve_first(int count) {
    // what was posed before stays as it is
    while (problem_.count < count) pose(problem_.count, problem_.count), ++problem_.count;
    forces_ = {work_.forces.data(), static_cast<std::size_t>(count)};
    std::ranges::copy(std::span(work_.before).first(forces_.size()), forces_.begin());
    const physics::ContactSolution solution = physics::solve_contacts(problem_, forces_, work_.solver);
    state_.node_force_count = 0;
    for (int i = 0; i < count; ++i) {
      ToolContact& contact = state_.contacts[i];
      contact.force = forces_[i];
      work_.gaps[i] = physics::gap_of(problem_, forces_, i);
      const Vec3 slip = work_.gaps[i] - work_.gaps[i].dot(contact.normal) * contact.normal;
      contact.sliding = slip.squaredNorm() > physics::kGapTolerance_m * physics::kGapTolerance_m;
      if (contact.touches()) share_force(model_, state_, contact);
    }
    propose_forces(state_, work_.surface);
    return solution;
  }

  // Whether what was left out is open under the forces that were solved for: as the surface can have moved by
  // their change, which is soon said, or by its own equation.
  bool stay_open() {
    const int solved = problem_.count;
    for (int i = solved; i < state_.contact_count; ++i) {
      ToolContact& contact = state_.contacts[i];
      contact.sliding = false;
      const double open_m = -depth_of(state_, contact, work_.surface);
      work_.gaps[i] = open_m * contact.normal;
      const bool alone = contact.other_dents.isZero(0);
      if (alone && open_m > work_.surface.motion_bound(contact.held) + kRounding_m) continue;
      pose(i, solved);
      work_.gaps[i] = physics::gap_of(problem_, forces_, i);
      if (work_.gaps[i].dot(contact.normal) < 0) return false;
    }
    return true;
  }

  const HapticModel& model_;
  std::span<const ToolInput> inputs_;
  HapticState& state_;
  HapticWorkspace& work_;
  physics::ContactProblem& problem_;
  bool near_others_;
  std::span<Vec3> forces_;  // of the contacts that were solved for
};

}  // namespace

physics::ContactSolution solve_point_contacts(const HapticModel& model, std::span<const ToolInput> inputs,
                                              int near, HapticState& state, HapticWorkspace& work) noexcept {
  return PointContacts(model, inputs, state, work).solve(near);
}

}  // namespace omentum::haptic
