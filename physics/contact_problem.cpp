#include "physics/contact_problem.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {

void limit_stiffness(ContactProblem& problem, int i, int columns) noexcept {
  const PointContact& contact = problem.contacts[i];
  const double compliance = contact.normal.dot(problem.W(i, i) * contact.normal);
  problem.root_c[i] = std::sqrt(std::max(0.0, 1 / contact.max_stiffness_n_m - compliance));
  if (problem.root_c[i] == 0) return;
  for (int j = 0; j < columns; ++j) {
    const double shared = problem.root_c[i] * problem.root_c[j];
    if (shared == 0 || problem.contacts[j].body != contact.body) continue;
    problem.W(i, j).diagonal().array() += shared;
    problem.W(j, i).diagonal().array() += shared;
  }
  problem.W(i, i).diagonal().array() += problem.root_c[i] * problem.root_c[i];
}

void limit_stiffness(ContactProblem& problem) noexcept {
  for (int i = 0; i < problem.count; ++i) limit_stiffness(problem, i, i);
}

Vec3 gap_of(const ContactProblem& problem, std::span<const Vec3> forces, int i) noexcept {
  Vec3 gap = problem.contacts[i].free_gap;
  if (i < std::ssize(forces)) gap -= kContactCompliance_m_n * forces[i];
  for (std::size_t j = 0; j < forces.size(); ++j) {
    if (!forces[j].isZero(0)) gap -= problem.W(i, static_cast<int>(j)) * forces[j];
  }
  return gap;
}

}  // namespace omentum::physics
