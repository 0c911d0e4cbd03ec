#include "physics/symmetric_tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omentum::physics {
namespace {

// of sums of up to 100 terms about 1
constexpr double kRounding = 1e-13;

std::span<double> components(Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

class SymmetricTilesTest : public testing::TestWithParam<int> {
 protected:
  SymmetricTilesTest() {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto next = [&] { return any(generator); };
    const Eigen::MatrixXd M = Eigen::MatrixXd::NullaryExpr(GetParam(), GetParam(), next);
    A = M + M.transpose();
    x = Eigen::VectorXd::NullaryExpr(GetParam(), next);
  }

  Eigen::MatrixXd A;
  Eigen::VectorXd x;
};

TEST_P(SymmetricTilesTest, AProductIsThatOfTheWholeMatrix) {
  SymmetricTiles tiles(A);
  Eigen::VectorXd y = Eigen::VectorXd::Constant(x.size(), std::nan(""));
  for (int twice = 0; twice < 2; ++twice) {
    tiles.product(components(x), components(y));
    EXPECT_LE((y - A * x).lpNorm<Eigen::Infinity>(), kRounding);
  }
}

TEST_P(SymmetricTilesTest, OnlyTheLowerHalfCounts) {
  const Eigen::MatrixXd lower = A.triangularView<Eigen::Lower>();
  Eigen::VectorXd y(x.size());
  SymmetricTiles(lower).product(components(x), components(y));
  EXPECT_LE((y - A * x).lpNorm<Eigen::Infinity>(), kRounding);
}

TEST_P(SymmetricTilesTest, AVectorMayBecomeItsProduct) {
  const Eigen::VectorXd expected = A * x;
  SymmetricTiles(A).product(components(x), components(x));
  EXPECT_LE((x - expected).lpNorm<Eigen::Infinity>(), kRounding);
}

// whole tiles, one that is not full, and nothing
INSTANTIATE_TEST_SUITE_P(Sizes, SymmetricTilesTest, testing::Values(0, 1, 2, 3, 7, 8, 9, 24, 61, 96));

}  // namespace
}  // namespace omentum::physics
