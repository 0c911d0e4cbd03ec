#include "physics/intestine/gut_carry.h"

#include "physics/obstacle.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

constexpr double kStep_s = 0.005;

// Springs as a matrix: displacements in a step per force, m/N, alike in all directions. Without contacts the
// masses would get to `rest_m` of their heights, `aside_m` along x; what is softer than the matrix takes
// several iterations.
class MatrixYield : public GutYield {
 public:
  MatrixYield(const Eigen::MatrixXd& compliance, const Eigen::VectorXd& rest_m, double softer = 1,
              double aside_m = 0)
      : compliance_(compliance),
        rest_m_(rest_m),
        softness_(softer),
        aside_m_(aside_m),
        own_(compliance.diagonal().begin(), compliance.diagonal().end()) {}
  int iterations() const noexcept override { return 8; }
  // x + A^-1 (H (rest - x) + f), H = A / softness
  void go_downhill(std::span<const Vec3> pushes_n, std::span<Vec3> x) noexcept override {
    std::vector<Vec3> way(x.size());
    yield_to(pushes_n, way);
    for (std::size_t m = 0; m < x.size(); ++m) {
      const Vec3 rest(aside_m_, 0, rest_m_[static_cast<Eigen::Index>(m)]);
      x[m] += way[m] + (rest - x[m]) / softness_;
    }
  }
  void end_step(std::span<const Vec3>, std::span<const Vec3>, std::span<Vec3>) noexcept override {}
  void yield_to(std::span<const Vec3> forces_n, std::span<Vec3> yield_m) const noexcept override {
    for (Eigen::Index i = 0; i < compliance_.rows(); ++i) {
      yield_m[static_cast<std::size_t>(i)].setZero();
      for (Eigen::Index j = 0; j < compliance_.cols(); ++j)
        yield_m[static_cast<std::size_t>(i)] += compliance_(i, j) * forces_n[static_cast<std::size_t>(j)];
    }
  }
  std::span<const double> own_yields() const noexcept override { return own_; }

 private:
  Eigen::MatrixXd compliance_;
  Eigen::VectorXd rest_m_;
  double softness_, aside_m_;
  std::vector<double> own_;
};

// A taut string of n masses, 2 g each, held at both ends: so stiff that a push on one moves all in a step.
Eigen::MatrixXd string_compliance(Eigen::Index n) {
  const double inertia = 0.002 / (kStep_s * kStep_s), stiffness = 1000;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, i) = inertia + 2 * stiffness;
    if (i + 1 < n) A(i, i + 1) = A(i + 1, i) = -stiffness;
  }
  return A.inverse();
}

// Each mass of the string over a floor at 0.
std::vector<GutContact> floor_under(std::int32_t n) {
  std::vector<GutContact> contacts(static_cast<std::size_t>(n));
  for (std::int32_t m = 0; m < n; ++m) contacts[static_cast<std::size_t>(m)].one = {{MassId(m)}, {1}};
  return contacts;
}

class GutCarryOf : public testing::TestWithParam<double> {};

// Springs as stiff as the matrix, and far softer ones: the forces are theirs, not the matrix'.
TEST_P(GutCarryOf, AStringOnAFloorFindsTheForcesOfTheComplementarityProblem) {
  constexpr std::int32_t kMasses = 12;
  const Eigen::MatrixXd compliance = string_compliance(kMasses);
  const std::vector<GutContact> contacts = floor_under(kMasses);
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd depth(kMasses);  // without the floor; some masses would stay above it
    for (double& d : depth) d = 0.002 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.3);
    const Eigen::VectorXd force = clear_obstacle(GetParam() * compliance, depth).value();
    MatrixYield yield(compliance, -depth, GetParam());
    GutCarry carry(kMasses, kMasses, contacts.size(), 0);
    const std::vector<Vec3> before(kMasses, Vec3(0, 0, 0.001));
    std::vector<Vec3> x(kMasses, Vec3::Zero()), v = x;
    std::vector<Vec3> pushes(kMasses, Vec3::Zero());
    const std::vector<double> inverse_mass(kMasses, 500);
    for (int step = 0; step < 60; ++step) {  // the same load again and again, as at rest
      carry.solve(contacts, yield, kStep_s, {before, x, v, inverse_mass}, pushes);
      for (const Vec3& push : pushes) EXPECT_GE(push.z(), 0);
    }
    for (const Vec3& place : x) EXPECT_GT(place.z(), -1e-5);  // of depths up to 1.4 mm
    for (std::int32_t m = 0; m < kMasses; ++m)
      EXPECT_NEAR(pushes[static_cast<std::size_t>(m)].z() / kStep_s, force[m], 0.01 * force.maxCoeff());
  }
}

INSTANTIATE_TEST_SUITE_P(Softness, GutCarryOf, testing::Values(1.0, 4.0));

// Pulled along the floor by less and by more than friction holds.
TEST(GutCarry, FrictionHoldsWhatIsPulledWithLessThanItsShareOfThePush) {
  for (const double share : {0.2, 0.4}) {
    constexpr double kFriction = 0.3, kDown_m = 0.001;
    const Eigen::MatrixXd compliance = Eigen::MatrixXd::Constant(1, 1, 1e-3);
    MatrixYield yield(compliance, Eigen::VectorXd::Constant(1, -kDown_m), 2, share * kDown_m);
    GutCarry carry(1, 1, 1, kFriction);
    const std::vector<GutContact> contacts = floor_under(1);
    const std::vector<Vec3> before(1, Vec3::Zero());
    const std::vector<double> inverse_mass(1, 500);
    std::vector<Vec3> x(1, Vec3::Zero()), v = x, pushes = x;
    for (int step = 0; step < 20; ++step)
      carry.solve(contacts, yield, kStep_s, {before, x, v, inverse_mass}, pushes);
    const double force_n = kDown_m / compliance(0, 0) / 2;
    EXPECT_NEAR(pushes[0].z() / kStep_s, force_n, 1e-3 * force_n);
    EXPECT_NEAR(-pushes[0].x() / kStep_s, std::min(share, kFriction) * force_n, 2e-3 * force_n);
    EXPECT_NEAR(x[0].x(), std::max(0.0, share - kFriction) * kDown_m, 2e-3 * kDown_m);
  }
}

TEST(GutCarry, APushIsForgottenWhereNothingIsPressedAnyMore) {
  MatrixYield yield(string_compliance(3), Eigen::VectorXd::Constant(3, 0.02));
  const std::vector<GutContact> contacts = floor_under(3);
  GutCarry carry(3, 3, 3, 0);
  const std::vector<Vec3> before(3, Vec3(0, 0, 0.02));
  std::vector<Vec3> x(3, Vec3(0, 0, 0.02)), v(3, Vec3::Zero());
  const std::vector<double> inverse_mass(3, 500);
  std::vector<Vec3> pushes(3, Vec3(0, 0, 1e-4));
  carry.solve(contacts, yield, kStep_s, {before, x, v, inverse_mass}, pushes);
  for (const Vec3& push : pushes) EXPECT_LT(push.norm(), 1e-5);
  for (const Vec3& place : x) EXPECT_NEAR(place.z(), 0.02, 1e-5);
}

}  // namespace
}  // namespace omentum::physics
