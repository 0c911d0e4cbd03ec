#include "physics/dynamics/explicit_step.h"

#include "physics/dynamics/energy_watch.h"
#include "physics/stiffness_factor.h"
#include "tests/physics/dynamics/swinging_body.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <numeric>

namespace omentum::physics {
namespace {

using test::SwingingBody;

constexpr double kShare = 0.9;  // of the stable step
constexpr double kLongRun_s = 60;
// Of critical damping, in the fastest mode: without any, forward Euler has no stable step.
constexpr double kFastestDamping = 0.14;

class ExplicitStepTest : public testing::TestWithParam<ExplicitScheme> {
 protected:
  SwingingBody body;
  const double highest_rad_s = highest_frequency(body.law, body.inertia).rad_s;

  void damp_forward_euler() {
    if (GetParam() == ExplicitScheme::kForwardEuler)
      body.inertia.stiffness_damping_s = 2 * kFastestDamping / highest_rad_s;
  }
  double step_s(double share = kShare) const {
    return share * stable_step_s(GetParam(), body.inertia, highest_rad_s);
  }
  const std::vector<double> nothing = std::vector<double>(3 * body.mesh.positions.size(), 0);
};

INSTANTIATE_TEST_SUITE_P(By, ExplicitStepTest, testing::ValuesIn(kExplicitSchemes), [](const auto& test) {
  std::string name = name_of(test.param);
  std::erase(name, '-');
  return name;
});

// Sixty simulated seconds, one tetrahedron in two hundred steps cut away until half of them are gone.
TEST_P(ExplicitStepTest, EnergyNeverGrowsWithoutWorkCutsIncluded) {
  damp_forward_euler();
  const double dt = step_s();
  ExplicitStep stepper(GetParam(), body.inertia);
  BodyState state = body.pushed();
  const double start_j = body.energy(state);
  EnergyWatch watch(energy_margin(GetParam(), kShare), 0);
  watch.restart(start_j);
  std::vector<std::size_t> order(body.mesh.tetrahedra.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, std::mt19937(4));

  std::size_t next = 0, step = 0;
  double largest_j = 0;
  for (double t = 0; t < kLongRun_s; t += dt, ++step) {
    if (step % 200 == 199 && next < order.size() / 2) body.law.remove(geometry::TetId(order[next++]));
    ASSERT_EQ(stepper.step(body.law, nothing, dt, state), 0);
    if (step % 10 != 0) continue;
    const double energy_j = body.energy(state);
    largest_j = std::max(largest_j, energy_j);
    ASSERT_TRUE(watch.accepts(energy_j, 10 * dt)) << "after " << t << " s: " << energy_j << " J";
  }
  EXPECT_EQ(next, order.size() / 2);
  EXPECT_LE(largest_j, energy_margin(GetParam(), kShare) * start_j);
}

TEST_P(ExplicitStepTest, StepBeyondStableOneIsNoticedBeforeItIsSeen) {
  damp_forward_euler();
  const double dt = step_s(1.1);
  ExplicitStep stepper(GetParam(), body.inertia);
  BodyState state = body.pushed();
  const double start_j = body.energy(state);
  EnergyWatch watch(energy_margin(GetParam(), kShare), 0);
  watch.restart(start_j);
  int steps = 0;
  double energy_j = start_j;
  do {
    ASSERT_LT(++steps, 5000);
    ASSERT_EQ(stepper.step(body.law, nothing, dt, state), 0);
    energy_j = body.energy(state);
  } while (watch.accepts(energy_j, dt));
  EXPECT_LT(energy_j, 100 * start_j);
}

TEST_P(ExplicitStepTest, HeldComponentsStayWhereTheyAre) {
  damp_forward_euler();
  body.inertia.fixed[7] = 2;  // y alone
  ExplicitStep stepper(GetParam(), body.inertia);
  BodyState state = body.pushed();
  const BodyState start = state;
  const std::vector<double> pull(state.u.size(), 1e-3);
  for (int i = 0; i < 50; ++i) EXPECT_GT(std::abs(stepper.step(body.law, pull, step_s(), state)), 0);
  for (std::size_t i = 0; i < state.u.size(); ++i) {
    if (is_fixed(body.inertia.fixed[i / 3], static_cast<int>(i % 3)) && i / 3 != 7) {
      EXPECT_EQ(state.u[i], start.u[i]);
      EXPECT_EQ(state.v[i], 0);
    }
  }
}

TEST_P(ExplicitStepTest, WorkOfExternalForcesIsWhatTheBodyGains) {
  body.inertia.stiffness_damping_s = 0;
  // far below the limit, where energy is kept closely by all schemes
  const double dt = 0.002 / highest_rad_s;
  ExplicitStep stepper(GetParam(), body.inertia);
  BodyState state = body.pushed();
  const double start_j = body.energy(state);
  const std::vector<double> pull = test::random_values(state.u.size(), 1e-3, 9);
  double work_j = 0, exchanged_j = 0;
  for (int i = 0; i < 5000; ++i) {
    const double step_j = stepper.step(body.law, pull, dt, state);
    work_j += step_j;
    exchanged_j += std::abs(step_j);
  }
  EXPECT_NEAR(body.energy(state) - start_j, work_j, 0.03 * exchanged_j + 0.01 * start_j);
}

TEST_P(ExplicitStepTest, MomentumIsKeptWithoutSupports) {
  damp_forward_euler();
  BodyState state = body.pushed();
  std::ranges::fill(body.inertia.fixed, 0);
  ExplicitStep stepper(GetParam(), body.inertia);
  const auto momentum = [&] {
    Vec3 total = Vec3::Zero();
    for (std::size_t n = 0; n < body.inertia.mass.size(); ++n)
      total += body.inertia.mass[n] * Vec3(state.v[3 * n], state.v[3 * n + 1], state.v[3 * n + 2]);
    return total;
  };
  const Vec3 start = momentum();
  const double dt = 0.8 * step_s();  // free, the body has a faster mode than held
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(stepper.step(body.law, nothing, dt, state), 0);
  EXPECT_LE((momentum() - start).norm(), 1e-4 * start.norm());
}

TEST_P(ExplicitStepTest, AllocatesNothing) {
  ExplicitStep stepper(GetParam(), body.inertia);
  BodyState state = body.pushed();
  const std::size_t before = test::heap_allocations();
  const double work_j = stepper.step(body.law, nothing, 1e-6, state);
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_EQ(work_j, 0);
}

// Of one oscillator of 1 rad/s after one second: halving the step divides the error by 2 to the order.
double error_after_a_second(ExplicitScheme scheme, int steps) {
  test::Springs spring({1});
  const Inertia inertia{{1}, {0}, 0.3, 0.2};
  ExplicitStep stepper(scheme, inertia);
  BodyState state{{1, 0, 0}, {0, 0, 0}};
  const std::vector<double> nothing(3, 0);
  for (int i = 0; i < steps; ++i) EXPECT_EQ(stepper.step(spring, nothing, 1.0 / steps, state), 0);
  const double decay = 0.25, swing = std::sqrt(1 - decay * decay);
  const double exact = std::exp(-decay) * (std::cos(swing) + decay / swing * std::sin(swing));
  return std::abs(state.u[0] - exact);
}

TEST_P(ExplicitStepTest, ErrorFallsWithOrderOfScheme) {
  const double order = GetParam() == ExplicitScheme::kRungeKutta4 ? 4 : 1;
  const double ratio = error_after_a_second(GetParam(), 20) / error_after_a_second(GetParam(), 40);
  EXPECT_NEAR(std::log2(ratio), order, 0.2);
}

// Undamped, symplectic Euler keeps E + dt v . f / 2 to rounding.
TEST(SymplecticEuler, KeepsItsOwnEnergyFor60Seconds) {
  SwingingBody body(SwingingBody::Arithmetic::kDouble);
  const double dt = kShare * stable_step_s(ExplicitScheme::kSymplecticEuler, body.inertia,
                                           highest_frequency(body.law, body.inertia).rad_s);
  ExplicitStep stepper(ExplicitScheme::kSymplecticEuler, body.inertia);
  BodyState state = body.pushed();
  const std::vector<double> nothing(state.u.size(), 0);
  const auto kept = [&] {
    return body.energy(state) + dt / 2 * test::dot(state.v, test::forces_of(body.law, state.u));
  };
  const double start = kept();
  for (double t = 0; t < kLongRun_s; t += dt) ASSERT_EQ(stepper.step(body.law, nothing, dt, state), 0);
  EXPECT_NEAR(kept(), start, 1e-9 * start);
}

// Undamped, Runge-Kutta 4 loses energy in every step.
TEST(RungeKutta, EnergyFallsInEveryStep) {
  SwingingBody body(SwingingBody::Arithmetic::kDouble);
  const double dt = kShare * stable_step_s(ExplicitScheme::kRungeKutta4, body.inertia,
                                           highest_frequency(body.law, body.inertia).rad_s);
  ExplicitStep stepper(ExplicitScheme::kRungeKutta4, body.inertia);
  BodyState state = body.pushed();
  const std::vector<double> nothing(state.u.size(), 0);
  double last = body.energy(state);
  for (int i = 0; i < 5000; ++i) {
    ASSERT_EQ(stepper.step(body.law, nothing, dt, state), 0);
    const double energy_j = body.energy(state);
    ASSERT_LE(energy_j, last * (1 + 1e-13)) << "step " << i;
    last = energy_j;
  }
}

TEST(ExplicitStep, DampedBodyComesToRestWhereDirectSolveIs) {
  SwingingBody body(SwingingBody::Arithmetic::kDouble);
  body.inertia.mass_damping_per_s = 20;
  const double dt = kShare * stable_step_s(ExplicitScheme::kSymplecticEuler, body.inertia,
                                           highest_frequency(body.law, body.inertia).rad_s);
  ExplicitStep stepper(ExplicitScheme::kSymplecticEuler, body.inertia);
  BodyState state = state_at_rest(body.mesh.positions.size());
  std::vector<double> weight(state.u.size());
  const std::vector<Vec3> gravity = body_forces(body.mesh, body.material, {0, 9.81, 0});
  const FreeDofs free = free_dofs(body.inertia.fixed);
  Eigen::MatrixXd free_weight(free.count, 1);
  for (std::size_t i = 0; i < weight.size(); ++i) {
    weight[i] = gravity[i / 3][static_cast<Eigen::Index>(i % 3)];
    if (free.index[i] >= 0) free_weight(free.index[i], 0) = weight[i];
  }
  double work_j = 0;
  for (double t = 0; t < 6; t += dt) work_j += stepper.step(body.law, weight, dt, state);

  const Eigen::MatrixXd expected =
      StiffnessFactor(assemble_stiffness(body.mesh, body.material), free).solve(free_weight);
  double error = 0;
  for (std::size_t i = 0; i < weight.size(); ++i)
    if (free.index[i] >= 0) error = std::max(error, std::abs(state.u[i] - expected(free.index[i], 0)));
  EXPECT_LE(error, 1e-6 * expected.cwiseAbs().maxCoeff());
  // twice the energy of the rest: half of it was lost to damping
  EXPECT_NEAR(work_j, 2 * body.law.energy(state.u), 1e-6 * work_j);
}

}  // namespace
}  // namespace omentum::physics
