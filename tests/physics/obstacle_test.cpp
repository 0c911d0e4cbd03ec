#include "physics/obstacle.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

constexpr double kZero = 1e-9;  // relative, of what clear_obstacle calls zero

Eigen::MatrixXd random_compliance(Eigen::Index n, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
  return root * root.transpose() + 0.01 * Eigen::MatrixXd::Identity(n, n);
}

TEST(ObstacleTest, ItPushesOnlyAndOnlyWhereItTouches) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto n = static_cast<Eigen::Index>(1 + seed % 40);
    const Eigen::MatrixXd A = random_compliance(n, seed);
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal(0.2, 1);
    const Eigen::VectorXd g = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(generator); });
    const auto p = clear_obstacle(A, g);
    ASSERT_TRUE(p) << seed;
    const Eigen::VectorXd gap = A * *p - g;
    const double force = kZero * p->cwiseAbs().maxCoeff(), way = kZero * g.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < n; ++i) {
      EXPECT_GE((*p)[i], -force);
      EXPECT_GE(gap[i], -way);
      EXPECT_TRUE((*p)[i] <= force || gap[i] <= way) << "seed " << seed << ", place " << i;
    }
  }
}

TEST(ObstacleTest, WhatIsClearNeedsNoForce) {
  const auto p = clear_obstacle(random_compliance(5, 1), Eigen::VectorXd::Constant(5, -0.1));
  ASSERT_TRUE(p);
  EXPECT_EQ(p->maxCoeff(), 0);
  EXPECT_EQ(clear_obstacle({}, {})->size(), 0);
}

TEST(ObstacleTest, WhatIsNoComplianceIsNotSolved) {
  EXPECT_FALSE(clear_obstacle(-Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Ones(3)));
}

// The factor reads the lower half, the gaps the whole: halves that disagree send the first place to and fro.
TEST(ObstacleTest, WhatNeverSettlesIsGivenUp) {
  const Eigen::Matrix2d A{{1, -10}, {0.9, 1}};
  EXPECT_FALSE(clear_obstacle(A, Eigen::Vector2d(1, 2)));
}

}  // namespace
}  // namespace omentum::physics
