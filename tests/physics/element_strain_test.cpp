// The closed form of U - I against singular values.
#include "physics/element_strain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <random>

namespace omentum::physics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kExact = 1e-9;  // relative: single precision, in which strains are told, has 6e-8

/// sym(R^T F) - I by the singular values of F, and the smallest one negative where det F is.
Matrix3d by_singular_values(const Matrix3d& F) {
  const Eigen::JacobiSVD<Matrix3d> svd(F, Eigen::ComputeFullV);
  Vector3d s = svd.singularValues();
  if (F.determinant() < 0) s[2] = -s[2];
  return svd.matrixV() * (s - Vector3d::Ones()).asDiagonal() * svd.matrixV().transpose();
}

class TurnedStrain : public testing::Test {
 protected:
  Matrix3d random() {
    std::normal_distribution<double> normal;
    return Matrix3d::NullaryExpr([&] { return normal(generator_); });
  }
  Matrix3d turn() {
    return Eigen::Quaterniond(Eigen::Vector4d(random().reshaped().head<4>())).normalized().matrix();
  }
  /// Turned before and after it is stretched.
  Matrix3d stretched(double a, double b, double c) {
    return turn() * Vector3d(a, b, c).asDiagonal() * turn();
  }
  static void expect_exact(const Matrix3d& F) {
    const Matrix3d strain = turned_strain(F), expected = by_singular_values(F);
    EXPECT_LT((strain - expected).norm(), kExact * expected.norm()) << "F\n" << F;
  }

 private:
  std::mt19937 generator_{7};
};

TEST_F(TurnedStrain, IsExactForAnyF) {
  for (int i = 0; i < 5'000; ++i) expect_exact(random());
}

TEST_F(TurnedStrain, IsExactWhereStrainsAreThoseOfTissue) {
  for (int i = 0; i < 5'000; ++i) expect_exact(turn() * (Matrix3d::Identity() + 0.1 * random()));
}

TEST_F(TurnedStrain, IsExactWhereTwoStretchesOrAllAreAlikeOrNearlySo) {
  for (const double near : {0.0, 1e-15, 1e-12, 1e-9, 1e-6}) {
    for (int i = 0; i < 1000; ++i) {
      expect_exact(stretched(1.3, 1.3 + near, 0.8));
      expect_exact(stretched(1.3, 0.8 - near, 0.8));
      expect_exact(stretched(1.3, 1.3 + near, 1.3));
    }
  }
}

TEST_F(TurnedStrain, IsExactWhereAnElementIsFlatOrAThread) {
  for (const double flat : {1e-1, 1e-2, 1e-3, 1e-6, 0.0}) {
    for (int i = 0; i < 1000; ++i) {
      expect_exact(stretched(1.5, 0.7, flat));
      expect_exact(stretched(1.5, 2 * flat, flat));
      expect_exact(stretched(1.5, 0.7, -flat));
    }
  }
}

}  // namespace
}  // namespace omentum::physics
