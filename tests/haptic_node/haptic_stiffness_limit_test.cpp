// What a device can render: contacts are no stiffer than it.
#include "tests/haptic_node/contact_problems.h"

namespace omentum::physics {
namespace {

using Eigen::Matrix3d;

// A tool of `count` points pressed into a wall of which the points feel `W`, each to its own depth.
std::unique_ptr<ContactProblem> wall(int count, double stiffness, std::mt19937& random) {
  auto problem = std::make_unique<ContactProblem>();
  problem->count = count;
  std::uniform_real_distribution<double> depth(0, 0.01);
  for (int i = 0; i < count; ++i) {
    problem->contacts[i].free_gap = Vec3(0, 0, -depth(random));
    problem->contacts[i].max_stiffness_n_m = stiffness;
    for (int j = 0; j < count; ++j) problem->W(i, j).setZero();
  }
  return problem;
}

double push_of(const std::vector<Vec3>& forces) {
  double push = 0;
  for (const Vec3& f : forces) push -= f.z();
  return push;
}

TEST(StiffnessLimit, APinnedWallIsAsStiffAsTheDeviceHoweverManyPointsTouch) {
  std::mt19937 random(8);
  constexpr double kStiffness = 2000;
  for (const double friction : {0.0, 0.3}) {
    for (int trial = 0; trial < 100; ++trial) {
      const auto problem = wall(1 + trial % 8, kStiffness, random);
      problem->friction = friction;
      double deepest = 0;
      for (int i = 0; i < problem->count; ++i) {
        deepest = std::max(deepest, -problem->contacts[i].free_gap.z());
      }
      limit_stiffness(*problem);
      const double push = push_of(solve(*problem));
      EXPECT_LE(push, kStiffness * (deepest + kGapTolerance_m));
      EXPECT_GE(push, 0.99 * kStiffness * (deepest - kGapTolerance_m)) << "and no softer than it must be";
    }
  }
}

TEST(StiffnessLimit, TwoToolsOnOneWallFeelOneSpringEach) {
  std::mt19937 random(9);
  const auto problem = wall(2, 1000, random);
  for (int i = 0; i < 2; ++i) problem->contacts[i].free_gap = Vec3(0, 0, -0.004);
  problem->contacts[1].body = 1;
  limit_stiffness(*problem);
  for (const Vec3& f : solve(*problem)) EXPECT_NEAR(f.z(), -4, 0.01);
}

TEST(StiffnessLimit, ASoftOrgansAnswerIsUnchanged) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 50; ++trial) {
    const auto problem = random_problem(8, trial % 2 ? 0.3 : 0, random);
    const std::vector<Vec3> before = solve(*problem);
    for (int i = 0; i < problem->count; ++i) problem->contacts[i].max_stiffness_n_m = 3 / kCompliance;
    limit_stiffness(*problem);
    EXPECT_EQ(solve(*problem), before);
  }
}

// A soft point that is pressed deep keeps its force when a point on the support begins to touch.
TEST(StiffnessLimit, APointThatBeginsToTouchMovesNoForce) {
  std::mt19937 random(11);
  const auto problem = wall(2, 1000, random);
  problem->W(0, 0) = kCompliance * Matrix3d::Identity();
  problem->contacts[0].free_gap = Vec3(0, 0, -0.01);
  problem->contacts[1].free_gap = Vec3(0, 0, -1e-9);
  limit_stiffness(*problem);
  const std::vector<Vec3> forces = solve(*problem);
  EXPECT_NEAR(forces[0].z(), -0.01 / kCompliance, kForceTolerance_n);
  EXPECT_NEAR(forces[1].z(), 0, kForceTolerance_n);
}

}  // namespace
}  // namespace omentum::physics
