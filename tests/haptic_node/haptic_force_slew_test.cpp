// The exit's promise about steps: what leaves in one tick and in the next differs by the slew limit at most,
// but for what falls at once.
#include "tests/haptic_node/force_watch.h"

#include <gtest/gtest.h>

#include <random>

namespace omentum::haptic_test {
namespace {

using haptic::ForceLimits;
using haptic::ForceSafety;
using haptic::SafeForce;
using haptic::SafetyInput;
using haptic::Vec3;

constexpr double kSlewRounding_n = 1e-9;

// A hand, a model that feeds it and turns as it likes, pauses, silences and ticks of any length.
class AnyHand {
 public:
  const SafetyInput& next() {
    if (chance(0.01)) feeds_ = uniform(-60, 120);
    if (chance(0.01)) velocity_ = 0.3 * any_direction();
    if (chance(0.03)) jump_ = uniform(0, 12) * any_direction();
    if (chance(0.1)) jump_.setZero();
    input_.dt_s = chance(0.1) ? uniform(0, 0.02) : chance(0.5) ? 0.25e-3 : 1e-3;
    const bool heard = chance(0.95) && silence_-- <= 0;
    if (chance(0.001)) silence_ = 40;
    input_.pose_age_s = heard ? 0 : input_.pose_age_s + input_.dt_s;
    input_.way_s = heard ? std::max(input_.dt_s, 1e-4) : 0;
    input_.tip += input_.way_s * velocity_;
    if (chance(0.002)) input_.paused = !input_.paused;
    input_.reconnected = chance(0.0005);
    input_.engaged = !chance(0.0005);
    input_.model.force = chance(0.05) ? Vec3(Vec3::Zero()) : Vec3(feeds_ * velocity_ + jump_);
    input_.model.torque = 0.02 * jump_;
    input_.stored_j = uniform(0, 0.02);
    return input_;
  }

 private:
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  bool chance(double p) { return uniform(0, 1) < p; }
  Vec3 any_direction() { return Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized(); }

  std::mt19937 random_{11};
  SafetyInput input_;
  Vec3 velocity_ = Vec3::Zero(), jump_ = Vec3::Zero();
  double feeds_ = 0;
  int silence_ = 0;
};

TEST(ForceSlew, WhatLeavesMakesOneStepOfTheLimitAtMostBeyondWhatFalls) {
  constexpr int kTicks = 100'000;
  const ForceLimits limits;
  ForceSafety safety(limits);
  AnyHand hand;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  int fell = 0, slewed = 0, damped = 0;
  for (int i = 0; i < kTicks; ++i) {
    const SafetyInput& input = hand.next();
    const SafeForce out = safety.pass(input);
    const double step_n = limits.max_slew_n_s * std::min(input.dt_s, limits.period_s);
    const double step_nm = step_n * limits.max_torque_nm / limits.max_force_n;
    ASSERT_LE(risen_n(force, out.wrench.force), step_n + kSlewRounding_n) << "tick " << i;
    ASSERT_LE(risen_n(torque, out.wrench.torque), step_nm + kSlewRounding_n) << "tick " << i;
    ASSERT_LE(out.wrench.force.norm(), limits.max_force_n + kSlewRounding_n);
    fell += (out.wrench.force - force).norm() > step_n;
    slewed += (out.state & msg::FORCE_SLEW) != 0;
    damped += (out.state & msg::FORCE_PASSIVITY) != 0 && safety.share() == 1;
    force = out.wrench.force;
    torque = out.wrench.torque;
  }
  EXPECT_GT(fell, kTicks / 1000);
  EXPECT_GT(slewed, kTicks / 100);
  EXPECT_GT(damped, kTicks / 1000);
}

}  // namespace
}  // namespace omentum::haptic_test
