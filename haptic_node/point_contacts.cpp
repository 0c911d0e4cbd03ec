#include "haptic_node/point_contacts.h"

#include "haptic_node/contact_list.h"
#include "haptic_node/node_forces.h"
#include "haptic_node/other_tools.h"

namespace omentum::haptic {
namespace {

// Of positions in float, m.
constexpr double kRounding_m = 2e-6;

class PointContacts {
 public:
  PointContacts(const HapticModel& model, std::span<const ToolInput> inputs, HapticState& state,
                HapticWorkspace& work)
      : inputs_(inputs),
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
    Body& body = work_.bodies[contact.body];
    work_.shares[i] = share_of(contact.place.nodes, body.contact_nodes());
    problem_.contacts[i] = {contact.place.normal, work_.free_gaps[i], contact.grasped, contact.tool,
                            inputs_[contact.tool].max_stiffness_n_m};
    for (int j = 0; j < columns; ++j) {
      find_compliance(body, i, j);
      problem_.W(j, i) = problem_.W(i, j).transpose();
    }
    find_compliance(body, i, i);
    physics::limit_stiffness(problem_, i, columns);
  }

  // Between contacts i, with `body`, and j. Bodies do not move each other.
  void find_compliance(Body& body, int i, int j) {
    const ToolContact &one = state_.contacts[i], &other = state_.contacts[j];
    Eigen::Matrix3d& W = problem_.W(i, j);
    if (one.body != other.body) {
      W.setZero();
      return;
    }
    ContactNodes& nodes = body.contact_nodes();
    haptic::find_compliance(nodes, work_.shares[i], work_.shares[j], W);
    if (near_others_ && one.tool != other.tool)
      W.diagonal().array() -= own_compliance(nodes, work_.shares[i], work_.shares[j]);
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
      const Vec3 slip = work_.gaps[i] - work_.gaps[i].dot(contact.place.normal) * contact.place.normal;
      contact.sliding = slip.squaredNorm() > physics::kGapTolerance_m * physics::kGapTolerance_m;
      if (contact.touches()) share_force(state_, contact);
    }
    propose_forces(state_, work_.bodies);
    return solution;
  }

  // Whether what was left out is open under the forces that were solved for: as the surface can have moved by
  // their change, which is soon said, or by its own equation.
  bool stay_open() {
    const int solved = problem_.count;
    for (int i = solved; i < state_.contact_count; ++i) {
      ToolContact& contact = state_.contacts[i];
      contact.sliding = false;
      const double open_m = -depth_of(state_, contact);
      work_.gaps[i] = open_m * contact.place.normal;
      const bool alone = contact.other_dents.isZero(0);
      if (alone && open_m > work_.bodies[contact.body].motion_bound(contact.held) + kRounding_m) continue;
      pose(i, solved);
      work_.gaps[i] = physics::gap_of(problem_, forces_, i);
      if (work_.gaps[i].dot(contact.place.normal) < 0) return false;
    }
    return true;
  }

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
