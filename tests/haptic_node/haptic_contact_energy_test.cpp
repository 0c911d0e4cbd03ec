// The energy that a hand gets back, on contacts simple enough to know the answer.
#include "haptic_node/contact_energy.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace omentum::haptic_test {
namespace {

using haptic::balance;
using haptic::ContactEnergy;
using haptic::ContactWork;
using haptic::Vec3;

constexpr double kStep_m = 1e-5;
// The trapezoidal rule over steps of 10 um in dents of millimetres, and what steps beside each other cost.
constexpr double kQuadrature = 1e-3;
// What is forgiven of the first touch (kShallow_m) beside a press of 1 mm.
constexpr double kForgiven = 1e-2;

// A point on a frictionless flat whose stiffness changes along x, as a mesh's does from node to face.
class BumpyFlat {
 public:
  static double stiffness(double x) { return 500 * (1 + 0.15 * std::sin(2 * std::numbers::pi * x / 0.008)); }
  static double push(const Vec3& tip) { return stiffness(tip.x()) * std::max(0.0, -tip.z()); }

  Vec3 felt() const { return energy_[0].share * Vec3(0, 0, push(tip_)) + energy_[0].side; }
  const ContactEnergy& energy() const { return energy_[0]; }
  double given_j() const { return given_j_; }
  double most_put_in_j() const { return -least_j_; }

  void move_to(const Vec3& to) {
    const Vec3 from = tip_;
    const int steps = static_cast<int>(std::ceil((to - from).norm() / kStep_m));
    for (int i = 1; i <= steps; ++i) step_to(from + i * (to - from) / steps);
  }

 private:
  void step_to(const Vec3& to) {
    const Vec3 felt_before = felt(), way = to - tip_;
    ContactWork work;
    work.stored_j = 0.5 * push(to) * std::max(0.0, -to.z());
    work.put_in_j = -0.5 * (push(tip_) + push(to)) * way.z();
    if (push(tip_) == 0) work.put_in_j = std::min(work.put_in_j, work.stored_j);
    work.push = Vec3(0, 0, -push(to));
    work.way = way;
    work.sliding = way.x() != 0 ? 1 : 0;
    tip_ = to;
    balance(energy_, std::array{work}, false);
    given_j_ += 0.5 * (felt_before + felt()).dot(way);
    least_j_ = std::min(least_j_, given_j_);
  }

  Vec3 tip_{0, 0, 1e-3};
  std::array<ContactEnergy, 1> energy_;
  double given_j_ = 0, least_j_ = 0;
};

TEST(ContactEnergy, APressThatDoesNotSlideFeelsTheModelsForce) {
  BumpyFlat flat;
  flat.move_to({0, 0, -0.006});
  EXPECT_NEAR(flat.energy().share, 1, kQuadrature);
  EXPECT_EQ(flat.energy().side, Vec3::Zero());
  flat.move_to({0, 0, 1e-3});
  EXPECT_NEAR(flat.given_j(), 0, kQuadrature * flat.most_put_in_j());
}

// Where a mesh makes of each joule put in a few per cent more or less: who presses feels the model's force
// whatever the depth, and gets back what was put in.
TEST(ContactEnergy, WhatAMeshMissesDoesNotCompoundInAPress) {
  constexpr double kStiffness_n_m = 100, kDepth_m = 6e-3;
  for (const double missed : {-0.04, 0.04}) {
    std::array<ContactEnergy, 1> tools;
    double given_j = 0, felt_n = 0, put_in_j = 0, before_m = 0;
    const auto go_to = [&](double depth_m) {
      const double push_n = kStiffness_n_m * depth_m;
      ContactWork work;
      work.stored_j = 0.5 * push_n * depth_m;
      work.put_in_j = (1 + missed) * 0.5 * (kStiffness_n_m * before_m + push_n) * (depth_m - before_m);
      work.push = Vec3(0, 0, -push_n);
      work.way = Vec3(0, 0, before_m - depth_m);
      const double share_before = tools[0].share;
      balance(tools, std::array{work}, false);
      given_j -= 0.5 * (share_before + tools[0].share) * work.put_in_j;
      put_in_j = std::max(put_in_j, -given_j);
      felt_n = tools[0].share * push_n;
      before_m = depth_m;
    };
    for (double depth_m = kStep_m; depth_m < kDepth_m; depth_m += kStep_m) go_to(depth_m);
    EXPECT_NEAR(felt_n, kStiffness_n_m * before_m, kQuadrature * felt_n);
    for (double depth_m = before_m - kStep_m; depth_m > 0; depth_m -= kStep_m) go_to(depth_m);
    EXPECT_NEAR(given_j, 0, kForgiven * put_in_j) << "of each joule " << missed;
  }
}

// Tissue that is told of late may hold joules that no hand brought, and hardly anything of that is felt. What
// is to come back by the way along it is bounded as well: without that, 8 N pushed a hand whose share was 0.
TEST(ContactEnergy, WhatIsNotCoveredPushesNoHandAside) {
  constexpr double kStored_j = 4, kPush_n = 40, kStroke_m = 4e-3, kWay_m = 2e-4, kRoof_j = 5e-3,
                   kKept_j = 1.5e-3;
  std::array<ContactEnergy, 1> tools;
  double tank_j = kRoof_j, most_n = 0;
  for (int step = 0; step < 1000; ++step) {
    const bool back = static_cast<int>(step * kWay_m / kStroke_m) % 2 == 1;
    ContactWork work{.stored_j = kStored_j, .covered_j = std::max(0.0, tank_j - kKept_j), .sliding = 1};
    work.push = Vec3(0, 0, -kPush_n);
    work.way = Vec3(back ? -kWay_m : kWay_m, 0, 0);
    const Vec3 before = tools[0].side;
    balance(tools, std::array{work}, false);
    most_n = std::max(most_n, tools[0].side.norm());
    tank_j = std::min(tank_j - 0.5 * (before + tools[0].side).dot(work.way), kRoof_j);
    ASSERT_GT(tank_j, kKept_j / 2) << "after " << step << " steps";
  }
  EXPECT_LE(most_n, kRoof_j / haptic::kHeading_m);
}

TEST(ContactEnergy, AClosedPathHasNoNetEnergy) {
  for (const double slide : {0.001, 0.002, 0.005, 0.011, 0.02}) {
    for (const double depth : {0.001, 0.004, 0.008}) {
      BumpyFlat flat;
      flat.move_to({0, 0, -depth});
      flat.move_to({slide, 0, -depth});
      flat.move_to({slide, 0, 1e-3});
      EXPECT_NEAR(flat.given_j(), 0, kForgiven * flat.most_put_in_j())
          << "slide " << slide << ", depth " << depth;
    }
  }
}

// Rubbing in a loop, never letting go, is where a source would show: each turn would give the same again.
TEST(ContactEnergy, AHandThatRubsInLoopsIsFedByNone) {
  BumpyFlat flat;
  flat.move_to({0, 0, -0.003});
  for (int turn = 0; turn < 50; ++turn) {
    flat.move_to({0.003, 0, -0.003});
    flat.move_to({0.003, 0, -0.006});
    flat.move_to({0, 0, -0.006});
    flat.move_to({0, 0, -0.003});
    ASSERT_LE(flat.given_j(), 0) << "turn " << turn;
  }
  EXPECT_GT(flat.energy().share, 0.7) << "and the tissue is not rubbed away";
}

TEST(ContactEnergy, AcrossASurfaceTheShareReturnsToOne) {
  BumpyFlat flat;
  flat.move_to({0, 0, -0.004});
  flat.move_to({0.002, 0, -0.004});
  const double at_first = 0.5 * std::abs(flat.energy().share - 1);
  // over the bumps it swings about one
  double mean = 0;
  for (int step = 1; step <= 80; ++step) {
    flat.move_to({0.05 + 0.0008 * step, 0, -0.004});
    mean += flat.energy().share / 80;
  }
  EXPECT_LT(std::abs(mean - 1), at_first);
}

// What another hand does to the tissue under a resting one is felt, and is no gain to be taken back.
TEST(ContactEnergy, WhatComesThroughTheTissueIsNoGainOfARestingTool) {
  std::array<ContactEnergy, 2> tools;
  std::array<ContactWork, 2> works;
  for (ContactWork& work : works) {
    work.stored_j = work.put_in_j = 1e-3;
    work.push = Vec3(0, 0, -0.5);
  }
  balance(tools, works, false);
  works[0].put_in_j = 0.3e-3, works[1].put_in_j = 0;
  works[0].stored_j = 1.2e-3;
  works[0].got_j = works[0].exchanged_j = -0.1e-3;
  works[1].stored_j = 1.1e-3;
  works[1].got_j = works[1].exchanged_j = 0.1e-3;
  balance(tools, works, false);
  EXPECT_NEAR(tools[0].share, 1, 1e-12);
  EXPECT_NEAR(tools[1].share, 1, 1e-12);
}

TEST(ContactEnergy, WhatIsDroppedIsNobodysGain) {
  std::array<ContactEnergy, 2> tools;
  std::array<ContactWork, 2> works;
  for (ContactWork& work : works) work.stored_j = work.put_in_j = 1e-3;
  balance(tools, works, false);
  works[0] = {};
  works[1] = {};
  works[1].stored_j = 0.8e-3;
  balance(tools, works, true);
  EXPECT_EQ(tools[0].stored_j, 0);
  EXPECT_EQ(tools[1].share, 1);
}

// Points that take over the load of one that was let go of may hold more than it did.
TEST(ContactEnergy, WhatIsTakenOverFromADroppedContactIsNoGain) {
  std::array<ContactEnergy, 1> tools;
  std::array<ContactWork, 1> works;
  works[0].push = Vec3(0, 0, -0.5);
  works[0].stored_j = works[0].put_in_j = 1e-3;
  balance(tools, works, false);
  works[0].stored_j = 1.25e-3, works[0].put_in_j = 0;
  balance(tools, works, true);
  EXPECT_NEAR(tools[0].account_j, 1e-3, 1e-8);
}

// Two tools deep in one place take over each other's load from tick to tick.
TEST(ContactEnergy, WhatATouchHoldsThatNobodyBroughtIsNotFelt) {
  std::array<ContactEnergy, 1> tools;
  std::array<ContactWork, 1> works;
  works[0].push = Vec3(0, 0, -15);
  works[0].stored_j = 0.1;
  works[0].put_in_j = 1e-3;
  balance(tools, works, false);
  EXPECT_EQ(tools[0].account_j, 1e-3);
  EXPECT_NEAR(tools[0].share, 0.01, 1e-12);
}

TEST(ContactEnergy, ContactThatEndsIsForgotten) {
  BumpyFlat flat;
  flat.move_to({0, 0, -0.004});
  flat.move_to({0.006, 0, -0.004});
  EXPECT_NE(flat.energy().share, 1);
  flat.move_to({0.006, 0, 1e-3});
  EXPECT_EQ(flat.energy().share, 1);
  EXPECT_EQ(flat.felt(), Vec3::Zero());
}

}  // namespace
}  // namespace omentum::haptic_test
