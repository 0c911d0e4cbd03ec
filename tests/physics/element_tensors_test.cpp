#include "physics/element_tensors.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

using Displacements = std::array<Vec3, 4>;

// lambda and mu far apart, so that a transposed tensor shows.
const Material kStiffTissue{4000, 0.4, 1000};
constexpr double kTensorRounding = 1e-12;  // relative: a few dozen operations on numbers of one size

Corners random_corners(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-0.01, 0.01);
  Corners c;
  do {
    for (Vec3& p : c) p = Vec3::NullaryExpr([&] { return coordinate(generator); });
  } while (geometry::signed_volume(c[0], c[1], c[2], c[3]) < 1e-7);
  return c;
}

// The energy from the strain, by a way of its own: no M_j in it.
double energy(const Corners& c, const Displacements& u) {
  Eigen::Matrix3d edges, moved;
  for (int j = 0; j < 3; ++j) {
    edges.col(j) = c[j + 1] - c[0];
    moved.col(j) = u[j + 1] - u[0];
  }
  const Eigen::Matrix3d gradient = moved * edges.inverse();
  const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
  const double volume = edges.determinant() / 6;
  return volume * (kStiffTissue.lambda() / 2 * strain.trace() * strain.trace() +
                   kStiffTissue.mu() * strain.squaredNorm());
}

Eigen::Matrix<double, 12, 12> as_matrix(const ElementTensors& tensors) {
  Eigen::Matrix<double, 12, 12> K;
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) K.block<3, 3>(3 * j, 3 * k) = tensors[j][k];
  }
  return K;
}

Displacements unit_displacement(int component) {
  Displacements u;
  u.fill(Vec3::Zero());
  u[component / 3][component % 3] = 1;
  return u;
}

Displacements sum(const Displacements& a, const Displacements& b) {
  Displacements u;
  for (int j = 0; j < 4; ++j) u[j] = a[j] + b[j];
  return u;
}

class ElementTensorsTest : public testing::TestWithParam<unsigned> {
 protected:
  const Corners corners = random_corners(GetParam());
  const Eigen::Matrix<double, 12, 12> K = as_matrix(element_tensors(corners, kStiffTissue));

  double largest_force(const Displacements& u) const {
    Eigen::Matrix<double, 12, 1> all;
    for (int j = 0; j < 4; ++j) all.segment<3>(3 * j) = u[j];
    return (K * all).cwiseAbs().maxCoeff();
  }
};

INSTANTIATE_TEST_SUITE_P(Shapes, ElementTensorsTest, testing::Range(1u, 6u));

TEST_P(ElementTensorsTest, AreHessianOfEnergy) {
  // a quadratic form's differences are exact with any step: W(a + b) - W(a) - W(b) = a^T H b
  for (int a = 0; a < 12; ++a) {
    for (int b = 0; b < 12; ++b) {
      const Displacements ua = unit_displacement(a), ub = unit_displacement(b);
      const double hessian = energy(corners, sum(ua, ub)) - energy(corners, ua) - energy(corners, ub);
      EXPECT_NEAR(K(a, b), hessian, 100 * kTensorRounding * K.norm()) << a << ", " << b;
    }
  }
}

TEST_P(ElementTensorsTest, AreSymmetric) {
  EXPECT_LE((K - K.transpose()).norm(), kTensorRounding * K.norm());
}

TEST_P(ElementTensorsTest, TranslationGivesZeroForce) {
  Displacements u;
  u.fill(Vec3(0.3, -0.2, 0.5));
  EXPECT_LE(largest_force(u), kTensorRounding * K.norm());
}

TEST_P(ElementTensorsTest, InfinitesimalRotationGivesZeroForce) {
  const Vec3 axis(0.4, -0.7, 0.2);
  Displacements u;
  for (int j = 0; j < 4; ++j) u[j] = axis.cross(corners[j]);
  EXPECT_LE(largest_force(u), kTensorRounding * K.norm());
}

TEST_P(ElementTensorsTest, AreaNormalsPointOutwardAndSumToZero) {
  const std::array<Vec3, 4> M = area_normals(corners);
  EXPECT_LE((M[0] + M[1] + M[2] + M[3]).norm(), kTensorRounding * M[0].norm());
  for (int j = 0; j < 4; ++j) {
    EXPECT_LT(M[j].dot(corners[j] - corners[(j + 1) % 4]), 0)
        << "corner " << j << " lies outside its opposite face";
  }
}

}  // namespace
}  // namespace omentum::physics
