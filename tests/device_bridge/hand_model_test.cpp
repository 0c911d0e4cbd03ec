#include "device_bridge/hand_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omentum::device {
namespace {

constexpr double kDt_s = 1e-3;

scene::HandSpec hand_with_damping(double damping_n_s_m) {
  scene::HandSpec hand;
  hand.damping_n_s_m = damping_n_s_m;
  return hand;
}

const Motion kAtRest{};
const Motion kDisplaced{.position = {0.03, -0.02, 0.01}, .velocity = {0.1, 0.2, -0.3}};

TEST(HandModel, UndampedEnergyNeitherGrowsNorVanishes) {
  const scene::HandSpec hand = hand_with_damping(0);
  // semi-implicit Euler conserves a nearby energy: the true one differs by at most w dt / 2, to first order
  const double band = std::sqrt(hand.stiffness_n_m / hand.mass_kg) * kDt_s;
  Motion motion = kDisplaced;
  const double start_j = hand_energy(hand, motion, kAtRest);
  for (int i = 0; i < 100'000; ++i) {
    motion = step_hand(hand, motion, kAtRest, Vec3::Zero(), kDt_s);
    ASSERT_NEAR(hand_energy(hand, motion, kAtRest), start_j, band * start_j) << i;
  }
}

TEST(HandModel, AFreeHandDissipatesAllItsEnergy) {
  const scene::HandSpec hand;
  Motion motion = kDisplaced;
  const double start_j = hand_energy(hand, motion, kAtRest);
  double last_j = start_j;
  for (int i = 0; i < 1000; ++i) {
    motion = step_hand(hand, motion, kAtRest, Vec3::Zero(), kDt_s);
    const double energy_j = hand_energy(hand, motion, kAtRest);
    ASSERT_LE(energy_j, last_j * (1 + kDt_s)) << i;
    last_j = energy_j;
  }
  // amplitudes fall as exp(-d / (2 m) t) = exp(-30) in this second, energies as the square
  EXPECT_LT(last_j, 1e-20 * start_j);
}

TEST(HandModel, RestsWhereTheSpringBalancesTheForce) {
  const scene::HandSpec hand;
  const Vec3 force(1.0, -2.0, 0.5);
  const Motion target{.position = {0.1, 0.2, 0.3}};
  Motion motion = target;
  for (int i = 0; i < 2000; ++i) motion = step_hand(hand, motion, target, force, kDt_s);
  EXPECT_LT((hand.stiffness_n_m * (motion.position - target.position) - force).norm(), 1e-9);
  EXPECT_LT(motion.velocity.norm(), 1e-9);
}

TEST(HandModel, FollowsATargetOfConstantVelocityWithinAStep) {
  const scene::HandSpec hand;
  const Vec3 velocity(0.05, 0, -0.02);
  Motion motion{};
  Motion target{.velocity = velocity};
  for (int i = 0; i < 2000; ++i) {
    target.position += velocity * kDt_s;
    motion = step_hand(hand, motion, target, Vec3::Zero(), kDt_s);
  }
  // the step sees where the target is at its end: one step behind, no more
  EXPECT_LT((motion.position - target.position).norm(), 1.001 * velocity.norm() * kDt_s);
}

TEST(ShaftOrientation, TurnsZOntoTheShaft) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 shaft = i == 0 ? Vec3(0, 0, -2) : Vec3(normal(random), normal(random), normal(random));
    const Quat q = shaft_orientation(shaft);
    EXPECT_NEAR(q.norm(), 1, 1e-12);
    EXPECT_LT((q * Vec3::UnitZ() - shaft.normalized()).norm(), 1e-7);
  }
}

TEST(AngularVelocity, IsTheRateThatTurnsOneOrientationIntoTheNext) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal(0, 50);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 rate(normal(random), normal(random), normal(random));
    const Quat before(Eigen::AngleAxisd(0.1 * i, Vec3(1, 2, 3).normalized()));
    Quat after = Quat(Eigen::AngleAxisd(rate.norm() * kDt_s, rate.normalized())) * before;
    if (i % 2) after.coeffs() *= -1;  // the same orientation
    EXPECT_LT((angular_velocity(before, after, kDt_s) - rate).norm(), 1e-7 * rate.norm() + 1e-7);
  }
  EXPECT_EQ(angular_velocity(Quat::Identity(), Quat::Identity(), kDt_s).norm(), 0);
}

}  // namespace
}  // namespace omentum::device
