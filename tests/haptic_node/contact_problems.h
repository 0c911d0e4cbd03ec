// Contact problems that tests draw, and their solution.
#pragma once

#include "physics/contact_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <memory>
#include <random>

namespace omentum::physics {

// Compliances below are of the order of a soft organ's, 1e-2 m/N: a gap tolerance of 1e-6 m is 1e-4 N, times
// the condition of the problems drawn here.
inline constexpr double kCompliance = 1e-2;
inline constexpr double kForceTolerance_n = 100 * kGapTolerance_m / kCompliance;

inline Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

// A random contact problem with a compliance like an elastic body's: symmetric, positive definite, blocks
// that decay away from the diagonal. Normals lie within 30 degrees or so of z.
inline std::unique_ptr<ContactProblem> random_problem(int count, double friction, std::mt19937& random) {
  auto problem = std::make_unique<ContactProblem>();
  problem->count = count;
  problem->friction = friction;
  std::uniform_real_distribution<double> uniform(-0.5, 1.0);
  Eigen::MatrixXd factor(3 * count, 3 * count + 2);
  std::normal_distribution<double> normal;
  for (auto& entry : factor.reshaped()) entry = 0.3 * normal(random);
  const Eigen::MatrixXd W =
      kCompliance * (factor * factor.transpose() / count + Eigen::MatrixXd::Identity(3 * count, 3 * count));
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) problem->W(i, j) = W.block<3, 3>(3 * i, 3 * j);
    problem->contacts[i].normal = (Vec3::UnitZ() + 0.3 * random_vector(random)).normalized();
    // between 10 mm deep and 5 mm open, with some tangential motion
    problem->contacts[i].free_gap =
        -0.01 * uniform(random) * problem->contacts[i].normal + 0.003 * random_vector(random);
  }
  return problem;
}

inline std::vector<Vec3> solve(const ContactProblem& problem) {
  std::vector<Vec3> forces(problem.count, Vec3::Zero());
  const auto work = std::make_unique<ContactWorkspace>();
  const ContactSolution solution = solve_contacts(problem, forces, *work);
  EXPECT_EQ(solution.status, ContactStatus::kConverged) << "residual " << solution.residual_m;
  return forces;
}

}  // namespace omentum::physics
