#include "physics/dynamics/stable_step.h"

#include "tests/physics/dynamics/swinging_body.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <limits>

namespace omentum::physics {
namespace {

using test::SwingingBody;

constexpr double kFromAbove = 0.01;  // relative: how far the frequency is let above the exact one

double exact_frequency(SwingingBody& body) {
  const std::size_t size = 3 * body.mesh.positions.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  std::vector<double> unit(size, 0);
  const auto scale = [&](std::size_t i) {
    const bool held = is_fixed(body.inertia.fixed[i / 3], static_cast<int>(i % 3));
    return held ? 0 : 1 / std::sqrt(body.inertia.mass[i / 3]);
  };
  for (std::size_t j = 0; j < size; ++j) {
    unit[j] = 1;
    const std::vector<double> f = test::forces_of(body.law, unit);
    unit[j] = 0;
    for (std::size_t i = 0; i < size; ++i)
      A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = -f[i] * scale(i) * scale(j);
  }
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().maxCoeff());
}

TEST(HighestFrequency, IsFromAboveAndClose) {
  SwingingBody body;
  const double exact = exact_frequency(body);
  const HighestFrequency found = highest_frequency(body.law, body.inertia);
  EXPECT_GE(found.rad_s, exact * (1 - 1e-4));
  EXPECT_LE(found.rad_s, exact * (1 + 2 * kFromAbove));
  EXPECT_LT(found.evaluations, 5000);
}

TEST(HighestFrequency, OnlyFallsWhenSomethingIsRemoved) {
  SwingingBody body;
  double last = exact_frequency(body);
  for (int t = 0; t < 30; t += 3) {
    body.law.remove(geometry::TetId(t));
    const double now = exact_frequency(body);
    EXPECT_LE(now, last * (1 + 1e-6)) << t;
    last = now;
  }
}

TEST(HighestFrequency, IsZeroWhereNothingCanMove) {
  SwingingBody body;
  std::ranges::fill(body.inertia.fixed, kPinned);
  EXPECT_EQ(highest_frequency(body.law, body.inertia).rad_s, 0);
}

TEST(HighestFrequency, IsZeroWhereNothingIsLeft) {
  SwingingBody body;
  for (std::size_t t = 0; t < body.mesh.tetrahedra.size(); ++t) body.law.remove(geometry::TetId(t));
  EXPECT_EQ(highest_frequency(body.law, body.inertia).rad_s, 0);
}

struct Damping {
  double mass_per_s, stiffness_s;
};

// Oscillators from 1 to 1000 rad/s, equally loaded: their energy after 20,000 steps, or once it is a million
// times what it was, relative to the start.
double growth(ExplicitScheme scheme, const Damping& damping, double share) {
  constexpr double kHighest = 1000, kGrown = 1e6;
  constexpr int kSteps = 20'000;
  std::vector<double> stiffness;
  for (double w = 1; w <= kHighest * 1.001; w *= std::pow(10, 0.1)) stiffness.push_back(w * w);
  test::Springs law(stiffness);
  const Inertia inertia{std::vector<double>(stiffness.size(), 1), FixedComponents(stiffness.size(), 0),
                        damping.mass_per_s, damping.stiffness_s};
  const double dt = share * stable_step_s(scheme, inertia, kHighest);
  ExplicitStep stepper(scheme, inertia);
  BodyState state = state_at_rest(stiffness.size());
  for (std::size_t i = 0; i < state.u.size(); ++i) state.u[i] = 1 / std::sqrt(stiffness[i / 3]);
  const std::vector<double> nothing(state.u.size(), 0);
  const double start_j = law.energy(state.u);
  double now_j = start_j;
  for (int i = 0; i < kSteps && now_j < 10 * kGrown * start_j; ++i) {
    EXPECT_EQ(stepper.step(law, nothing, dt, state), 0);
    now_j = law.energy(state.u) + kinetic_energy(inertia, state.v);
  }
  return now_j / start_j;
}

class StableStepTest : public testing::TestWithParam<std::tuple<ExplicitScheme, Damping>> {};

INSTANTIATE_TEST_SUITE_P(Schemes, StableStepTest,
                         testing::Combine(testing::ValuesIn(kExplicitSchemes),
                                          testing::Values(Damping{0, 2.8e-4}, Damping{200, 0},
                                                          Damping{5, 1e-3}, Damping{3000, 0},
                                                          Damping{0, 0.01}, Damping{300, 0.002})));

TEST_P(StableStepTest, BelowItNoModeGrowsBeyondItOneDoes) {
  const auto& [scheme, damping] = GetParam();
  EXPECT_LT(growth(scheme, damping, 0.99), 1);
  // Runge-Kutta's is below the exact one, by 8 % at most
  EXPECT_GT(growth(scheme, damping, 1.15), 1e6);
}

TEST(StableStep, IsNoneForForwardEulerWithoutDamping) {
  const Inertia inertia{{1}, {0}};
  EXPECT_EQ(stable_step_s(ExplicitScheme::kForwardEuler, inertia, 100), 0);
}

// Cotin 1998, section 5.4, names a factor of ten between Runge-Kutta and Euler; against symplectic Euler it
// is sqrt 2.
TEST(StableStep, OfRungeKuttaIsSqrt2OfSymplecticEuler) {
  const Inertia inertia{{1}, {0}};
  const double ratio = stable_step_s(ExplicitScheme::kRungeKutta4, inertia, 100) /
                       stable_step_s(ExplicitScheme::kSymplecticEuler, inertia, 100);
  EXPECT_NEAR(ratio, std::sqrt(2), 1e-12);
}

TEST(StableStep, IsWithoutLimitWhereNothingSwings) {
  const Inertia inertia{{1}, {0}};
  for (const ExplicitScheme scheme : kExplicitSchemes)
    EXPECT_EQ(stable_step_s(scheme, inertia, 0), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace omentum::physics
