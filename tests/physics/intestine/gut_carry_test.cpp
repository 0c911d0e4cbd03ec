#include "physics/intestine/gut_carry.h"

#include "physics/obstacle.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

constexpr double kStep_s = 0.005;

// Springs as a matrix: displacements in a step per force, m/N, alike in all directions.
class MatrixYield : public GutYield {
 public:
  explicit MatrixYield(const Eigen::MatrixXd& compliance)
      : compliance_(compliance), own_(compliance.diagonal().begin(), compliance.diagonal().end()) {}
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

TEST(GutCarry, AStringOnAFloorFindsTheForcesOfTheComplementarityProblem) {
  constexpr std::int32_t kMasses = 12;
  const Eigen::MatrixXd compliance = string_compliance(kMasses);
  const std::vector<GutContact> contacts = floor_under(kMasses);
  const MatrixYield yield(compliance);
  GutCarry carry(kMasses, kMasses, contacts.size());
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd depth(kMasses);  // without the floor; some masses would stay above it
    for (double& d : depth) d = 0.002 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.3);
    const Eigen::VectorXd force = clear_obstacle(compliance, depth).value();
    const std::vector<Vec3> before(kMasses, Vec3(0, 0, 0.001));
    std::vector<Vec3> x, v;
    std::vector<double> lambda(kMasses, 0.0);
    const std::vector<double> inverse_mass(kMasses, 500);
    double worst = 0;
    for (int step = 0; step < 60; ++step) {  // the same load again and again, as at rest
      x.assign(kMasses, Vec3::Zero());
      v.assign(kMasses, Vec3::Zero());
      for (std::int32_t m = 0; m < kMasses; ++m) x[static_cast<std::size_t>(m)].z() = -depth[m];
      carry.solve(contacts, yield, kStep_s, {before, x, v, inverse_mass}, lambda);
      for (const double push : lambda) EXPECT_GE(push, 0);
      worst = 0;
      for (const Vec3& place : x) worst = std::max(worst, -place.z());
    }
    EXPECT_LT(worst, 1e-5);  // of depths up to 1.4 mm
    for (std::int32_t m = 0; m < kMasses; ++m)
      EXPECT_NEAR(lambda[static_cast<std::size_t>(m)] / kStep_s, force[m], 0.01 * force.maxCoeff());
  }
}

TEST(GutCarry, APushIsForgottenWhereNothingIsPressedAnyMore) {
  const MatrixYield yield(string_compliance(3));
  const std::vector<GutContact> contacts = floor_under(3);
  GutCarry carry(3, 3, 3);
  const std::vector<Vec3> before(3, Vec3(0, 0, 0.02));
  std::vector<Vec3> x(3, Vec3(0, 0, 0.02)), v(3, Vec3::Zero());
  const std::vector<double> inverse_mass(3, 500);
  std::vector<double> lambda(3, 1e-4);
  carry.solve(contacts, yield, kStep_s, {before, x, v, inverse_mass}, lambda);
  for (const double push : lambda) EXPECT_LT(push, 1e-5);
  for (const Vec3& place : x) EXPECT_NEAR(place.z(), 0.02, 1e-5);
}

}  // namespace
}  // namespace omentum::physics
