#include "haptic_node/contact_work.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// A contact that begins was in the air for a part of the way, and took no more work than it holds.
double put_in(const ToolContact& contact, const Vec3& before, const Vec3& way, double stored_j) {
  const double work_j = 0.5 * (before + contact.force).dot(way);
  return before.isZero(0) ? std::min(work_j, stored_j) : work_j;
}

// What the tissue's own way gave against these forces; a contact that begins got no more than it holds.
double given_by(const Vec3& way, const ToolContact& contact, const Vec3& before, double stored_j) {
  const double work_j = -0.5 * (before + contact.force).dot(way);
  return before.isZero(0) ? std::min(work_j, stored_j) : work_j;
}

// What friction takes: the material point will go on by the gap that is left along the surface.
double rubbed(const ToolContact& contact, const Vec3& gap) {
  const Vec3 along = contact.force - contact.force.dot(contact.place.normal) * contact.place.normal;
  return std::max(0.0, along.dot(gap));
}

// What tool t got from tool u by the model's own forces, J.
double passed(const physics::ContactProblem& problem, const HapticState& state, std::span<const Vec3> before,
              int u, int t) {
  double got_j = 0;
  for (int i = 0; i < problem.count; ++i) {
    if (state.contacts[i].tool != t) continue;
    const Vec3& force = state.contacts[i].force;
    for (int j = 0; j < problem.count; ++j) {
      if (state.contacts[j].tool != u) continue;
      const Eigen::Matrix3d& w = problem.W(i, j);
      got_j += 0.5 * (force.dot(w * before[j]) - before[i].dot(w * state.contacts[j].force));
    }
  }
  return got_j;
}

// How far the ways of a tool's points, by their forces, went across its push: 0 for a press, 1 for a slide,
// also where a push leans a little to its way.
double sliding_of(const HapticState& state, std::int32_t tool, const Vec3& push) {
  double across = 0, along = 0;
  if (push.isZero(0)) return 0;
  for (const ToolContact& contact : state.active()) {
    if (contact.tool != tool || !contact.touches()) continue;
    const Vec3 way = state.tools[tool].now[contact.point] - state.tools[tool].before[contact.point];
    // what is held does not slide, whichever way it is pulled
    const double pressed = way.dot(push),
                 squared = contact.grasped ? way.squaredNorm() : pressed * pressed / push.squaredNorm();
    along += contact.force.norm() * squared;
    across += contact.force.norm() * (way.squaredNorm() - squared);
  }
  const auto cube = [](double x) { return x * x * x; };
  const double all = along + across;
  return all > 0 ? cube(across / all) / (cube(across / all) + cube(along / all)) : 0;
}

}  // namespace

void measure_work(const HapticModel& model, const HapticState& state, std::span<const Vec3> before,
                  std::span<const Vec3> free_gaps, std::span<const Vec3> gaps,
                  std::span<ContactWork> works) noexcept {
  for (std::size_t t = 0; t < works.size(); ++t) {
    works[t] = {};
    works[t].way = state.tools[t].tip_way;
  }
  for (int i = 0; i < state.contact_count; ++i) {
    const ToolContact& contact = state.contacts[i];
    const ToolState& tool = state.tools[contact.tool];
    ContactWork& work = works[contact.tool];
    const Vec3 way = tool.now[contact.point] - tool.before[contact.point];
    const double stored_j = 0.5 * contact.force.dot(free_gaps[i] - gaps[i]);
    work.stored_j += stored_j;
    work.put_in_j += put_in(contact, before[i], way, stored_j);
    work.own_j += given_by(contact.place.drift.way, contact, before[i], stored_j);
    work.changed_j += given_by(contact.place.drift.blend, contact, before[i], stored_j);
    work.push += contact.force;
    if (model.friction > 0 && !contact.grasped) work.rubbed_j += rubbed(contact, gaps[i]);
  }
  for (std::size_t t = 0; t < works.size(); ++t)
    works[t].sliding = sliding_of(state, static_cast<std::int32_t>(t), works[t].push);
}

void settle_own_motion(HapticState& state, std::span<ContactWork> works) noexcept {
  for (std::size_t t = 0; t < works.size(); ++t) {
    ContactWork& work = works[t];
    ContactEnergy& energy = state.energies[t];
    if (work.stored_j < kNoEnergy_j) continue;
    const double own_j = work.own_j - work.changed_j, back_j = std::min(own_j, energy.lent_j);
    energy.lent_j -= back_j;
    work.got_j += own_j - back_j;
    work.exchanged_j += energy.share * (own_j - back_j);
    if (work.changed_j != 0) work.exchanged_j += state.tools[t].changes.credit(energy.share * work.changed_j);
    work.stored_j += energy.lent_j;
  }
}

void measure_exchange(const physics::ContactProblem& problem, const HapticState& state,
                      std::span<const Vec3> before, std::span<ContactWork> works) noexcept {
  const int tools = static_cast<int>(works.size());
  for (int t = 0; t < tools; ++t) {
    for (int u = 0; u < t; ++u) {
      const double got_j = passed(problem, state, before, u, t);
      const double felt_j = state.energies[got_j > 0 ? u : t].share * got_j;
      works[t].exchanged_j += felt_j;
      works[u].exchanged_j -= felt_j;
      works[t].got_j += got_j;
      works[u].got_j -= got_j;
    }
  }
}

}  // namespace omentum::haptic
