#include "haptic_node/contact_work.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// A contact that begins was in the air for a part of the way, and took no more work than it holds.
double put_in(const ToolContact& contact, const Vec3& before, const Vec3& way, double stored_j) {
  const double work_j = 0.5 * (before + contact.force).dot(way);
  return before.isZero(0) ? std::min(work_j, stored_j) : work_j;
}

// What friction takes: the material point will go on by the gap that is left along the surface.
double rubbed(const ToolContact& contact, const Vec3& gap) {
  const Vec3 along = contact.force - contact.force.dot(contact.normal) * contact.normal;
  return std::max(0.0, along.dot(gap));
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
    work.push += contact.force;
    if (model.friction > 0 && !contact.grasped) work.rubbed_j += rubbed(contact, gaps[i]);
  }
}

void measure_exchange(const physics::ContactProblem& problem, const HapticState& state,
                      std::span<const Vec3> before, std::span<ContactWork> works) noexcept {
  for (int i = 0; i < problem.count; ++i) {
    const ToolContact& one = state.contacts[i];
    for (int j = 0; j < i; ++j) {
      const ToolContact& other = state.contacts[j];
      if (other.tool == one.tool) continue;
      const double exchanged_j =
          0.5 * (one.force.dot(problem.W(i, j) * before[j]) - before[i].dot(problem.W(i, j) * other.force));
      works[one.tool].exchanged_j += exchanged_j;
      works[other.tool].exchanged_j -= exchanged_j;
    }
  }
}

}  // namespace omentum::haptic
