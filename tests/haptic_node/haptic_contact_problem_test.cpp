#include "tests/haptic_node/contact_problems.h"

#include <Eigen/Eigenvalues>

namespace omentum::physics {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Vec3> gaps(const ContactProblem& problem, const std::vector<Vec3>& forces) {
  std::vector<Vec3> result;
  for (int i = 0; i < problem.count; ++i) {
    Vec3 gap = problem.contacts[i].free_gap - kContactCompliance_m_n * forces[i];
    for (int j = 0; j < problem.count; ++j) gap -= problem.W(i, j) * forces[j];
    result.push_back(gap);
  }
  return result;
}

void expect_contact_laws(const ContactProblem& problem, const std::vector<Vec3>& forces) {
  const std::vector<Vec3> gap = gaps(problem, forces);
  for (int i = 0; i < problem.count; ++i) {
    if (problem.contacts[i].bilateral) {
      EXPECT_LE(gap[i].norm(), kGapTolerance_m);
      continue;
    }
    const Vec3& n = problem.contacts[i].normal;
    const double push = -forces[i].dot(n), open = gap[i].dot(n);
    const Vec3 tangential = forces[i] + push * n, slip = gap[i] - open * n;
    EXPECT_GE(push, -1e-12) << "tissue never pulls";
    EXPECT_GE(open, -kGapTolerance_m) << "no point stays inside";
    EXPECT_LE(std::min(push * kCompliance, open), 2 * kGapTolerance_m) << "an open contact carries no force";
    EXPECT_LE(tangential.norm(), problem.friction * push + 1e-12) << "friction cone";
    if (slip.norm() > 20 * kGapTolerance_m && push * kCompliance > 20 * kGapTolerance_m) {
      EXPECT_NEAR(tangential.norm(), problem.friction * push, kForceTolerance_n)
          << "sliding uses all friction";
      if (problem.friction > 0) {
        EXPECT_GT(tangential.dot(slip), 0.99 * tangential.norm() * slip.norm()) << "dragged along the slip";
      }
    }
  }
}

// The frictionless problem by trying every set of touching contacts.
std::vector<Vec3> brute_force(const ContactProblem& problem) {
  MatrixXd A(problem.count, problem.count);
  VectorXd q(problem.count);
  for (int i = 0; i < problem.count; ++i) {
    const Vec3& n = problem.contacts[i].normal;
    q(i) = -n.dot(problem.contacts[i].free_gap);
    for (int j = 0; j < problem.count; ++j) A(i, j) = n.dot(problem.W(i, j) * problem.contacts[j].normal);
    A(i, i) += kContactCompliance_m_n;
  }
  for (unsigned set = 0; set < (1u << problem.count); ++set) {
    std::vector<int> active;
    for (int i = 0; i < problem.count; ++i) {
      if (set >> i & 1) active.push_back(i);
    }
    VectorXd x = VectorXd::Zero(problem.count);
    if (!active.empty()) {
      const MatrixXd A_active = A(active, active);
      const VectorXd q_active = q(active), pushes = A_active.llt().solve(q_active);
      x(active) = pushes;
    }
    const VectorXd gap = q - A * x;
    if (x.minCoeff() < 0) continue;
    bool valid = true;
    for (int i = 0; i < problem.count; ++i) valid &= (set >> i & 1) || gap(i) <= 0;
    if (!valid) continue;
    std::vector<Vec3> forces;
    for (int i = 0; i < problem.count; ++i) forces.push_back(-x(i) * problem.contacts[i].normal);
    return forces;
  }
  ADD_FAILURE() << "a positive definite problem has exactly one solution";
  return {};
}

TEST(ContactProblem, FrictionlessEqualsEveryActiveSetTried) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const auto problem = random_problem(1 + trial % 8, 0, random);
    const std::vector<Vec3> found = solve(*problem), expected = brute_force(*problem);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_LE((found[i] - expected[i]).norm(), kForceTolerance_n) << "trial " << trial << ", contact " << i;
    }
  }
}

TEST(ContactProblem, ObeysSignoriniAndCoulomb) {
  std::mt19937 random(2);
  for (const double friction : {0.0, 0.1, 0.3, 0.6}) {
    for (int trial = 0; trial < 300; ++trial) {
      const auto problem = random_problem(1 + trial % 16, friction, random);
      if (trial % 5 == 0) problem->contacts[0].bilateral = true;
      expect_contact_laws(*problem, solve(*problem));
      if (HasFailure()) FAIL() << "friction " << friction << ", trial " << trial;
    }
  }
}

TEST(ContactProblem, AllStickingEqualsCholesky) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const auto problem = random_problem(kMaxContacts / 2, 0, random);
    const int n = 3 * problem->count;
    MatrixXd W = kContactCompliance_m_n * MatrixXd::Identity(n, n);
    VectorXd r(n);
    for (int i = 0; i < problem->count; ++i) {
      problem->contacts[i].bilateral = true;
      r.segment<3>(3 * i) = problem->contacts[i].free_gap;
      for (int j = 0; j < problem->count; ++j) W.block<3, 3>(3 * i, 3 * j) += problem->W(i, j);
    }
    const VectorXd expected = W.llt().solve(r);
    const std::vector<Vec3> found = solve(*problem);
    for (int i = 0; i < problem->count; ++i) {
      EXPECT_LE((found[i] - expected.segment<3>(3 * i)).norm(), 1e-9 * expected.norm());
    }
  }
}

TEST(ContactProblem, DoesNotDependOnTheOrderOfContacts) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const auto problem = random_problem(10, trial % 2 ? 0.3 : 0, random);
    auto reversed = std::make_unique<ContactProblem>(*problem);
    const int last = problem->count - 1;
    for (int i = 0; i <= last; ++i) {
      reversed->contacts[i] = problem->contacts[last - i];
      for (int j = 0; j <= last; ++j) reversed->W(i, j) = problem->W(last - i, last - j);
    }
    const std::vector<Vec3> one = solve(*problem), other = solve(*reversed);
    for (int i = 0; i <= last; ++i) EXPECT_LE((one[i] - other[last - i]).norm(), kForceTolerance_n);
  }
}

TEST(ContactProblem, DoesNotDependOnTheStart) {
  std::mt19937 random(5);
  const auto work = std::make_unique<ContactWorkspace>();
  for (int trial = 0; trial < 100; ++trial) {
    const auto problem = random_problem(8, trial % 2 ? 0.3 : 0, random);
    const std::vector<Vec3> cold = solve(*problem);
    std::vector<Vec3> warm(problem->count);
    for (Vec3& f : warm) f = random_vector(random);
    EXPECT_EQ(solve_contacts(*problem, warm, *work).status, ContactStatus::kConverged);
    for (int i = 0; i < problem->count; ++i) EXPECT_LE((warm[i] - cold[i]).norm(), kForceTolerance_n);
  }
}

// Eight points of a tool in one triangle: W has rank 9 for 24 unknowns. Rigid points over one triangle that
// they all press: the sum of forces must be what the triangle's three nodes need to follow.
TEST(ContactProblem, RedundantPointsInOneTriangleShareTheForce) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const double friction : {0.0, 0.4}) {
    for (int trial = 0; trial < 100; ++trial) {
      const auto nodes = random_problem(3, 0, random);  // the vertices' own compliance
      auto problem = std::make_unique<ContactProblem>();
      problem->count = 8;
      problem->friction = friction;
      std::array<Vec3, 8> k;
      for (int i = 0; i < 8; ++i) {
        k[i] = Vec3(uniform(random), uniform(random), uniform(random)) + Vec3::Constant(0.01);
        k[i] /= k[i].sum();
        problem->contacts[i].free_gap = Vec3(0.001, 0, -0.008);
      }
      for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < 8; ++j) {
          problem->W(i, j).setZero();
          for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) problem->W(i, j) += k[i][a] * k[j][b] * nodes->W(a, b);
          }
        }
      }
      expect_contact_laws(*problem, solve(*problem));
      if (HasFailure()) FAIL() << "trial " << trial;
    }
  }
}

TEST(ContactProblem, PinnedSurfaceIsAStiffWallNotASingularOne) {
  auto problem = std::make_unique<ContactProblem>();
  problem->count = 1;
  problem->W(0, 0).setZero();
  problem->contacts[0].free_gap = Vec3(0, 0, -1e-5);
  const std::vector<Vec3> forces = solve(*problem);
  EXPECT_NEAR(forces[0].z(), -1e-5 / kContactCompliance_m_n, 1e-9);
}

// std::max(worst, NaN) is worst: what is no number was reported as converged.
TEST(ContactProblem, WhatIsNoNumberIsNotConverged) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::mt19937 random(5);
  for (const double friction : {0.0, 0.4}) {
    for (const double wrong : {kNan, std::numeric_limits<double>::infinity()}) {
      auto in_gap = random_problem(4, friction, random), in_compliance = random_problem(4, friction, random);
      in_gap->contacts[2].free_gap.x() = in_gap->contacts[2].free_gap.z() = wrong;
      in_compliance->W(1, 1).setConstant(wrong);
      for (const auto* problem : {in_gap.get(), in_compliance.get()}) {
        std::vector<Vec3> forces(4, Vec3(0, 0, -1));
        ContactWorkspace work;
        EXPECT_EQ(solve_contacts(*problem, forces, work).status, ContactStatus::kNotFinite);
        for (const Vec3& force : forces) EXPECT_EQ(force, Vec3::Zero());
      }
    }
  }
}

TEST(ContactProblem, OpenContactsCarryNoForce) {
  std::mt19937 random(7);
  const auto problem = random_problem(6, 0.3, random);
  for (int i = 0; i < 6; ++i) problem->contacts[i].free_gap = 0.001 * problem->contacts[i].normal;
  for (const Vec3& f : solve(*problem)) EXPECT_EQ(f, Vec3::Zero());
}

}  // namespace
}  // namespace omentum::physics
