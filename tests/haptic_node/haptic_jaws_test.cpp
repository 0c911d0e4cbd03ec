// Jaws that close on tissue: what they hold, what they feel of it, and that no way of theirs gives energy.
#include "haptic_fixtures.h"
#include "haptic_node/force_safety.h"
#include "haptic_node/hand_account.h"
#include "haptic_node/jaws.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

namespace omentum::haptic_test {
namespace {

constexpr double kJawsOpen_rad = 0.5, kJawsShut_rad = 0.02, kHandTick_s = 1e-3;
constexpr double kBladeLength_m = 0.006, kBladeGap_m = 5e-4;  // of the jaws below

haptic::ToolModel round_jaws() {
  haptic::ToolModel tool = round_tool();
  tool.grasps = true;
  return tool;
}

/// Jaws whose inner faces are what touches: four points on each.
haptic::ToolModel flat_jaws() {
  haptic::ToolModel tool;
  tool.grasps = true;
  for (const double x : {-kBladeGap_m, kBladeGap_m}) {
    for (const double y : {-0.002, 0.002}) {
      for (const double z : {0.0, kBladeLength_m}) tool.points.emplace_back(x, y, z);
    }
  }
  return tool;
}

/// A held_flap of 6 x 4 cm, 8 mm thick, that is held where y = 0. Its far edge is free.
const TestOrgan& held_flap() {
  static const TestOrgan organ = make_organ(test::make_box_mesh(3, 10, 12, {0.008, 0.04, 0.06}),
                                            [](const Vec3& p) { return p.z() < 1e-9; });
  return organ;
}
/// Of its free edge's middle; jaws come from above, one to each face.
const Vec3 kFreeEdge(0.004, 0.02, 0.06);

/// A hand that moves, turns and closes its jaws, and what it was given.
class GraspingHand {
 public:
  GraspingHand(const TestOrgan& organ, const haptic::ToolModel& tool) : bench(make_model(organ, {tool})) {}

  void go_to(const Vec3& tip, double grip, int ticks, double roll = 0) {
    const haptic::ToolInput from = bench.input();
    const double roll_before = roll_;
    for (int i = 1; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / ticks;
      roll_ = roll_before + share * (roll - roll_before);
      step(bench.input().engaged ? Vec3(from.frame.p_WT + share * (tip - from.frame.p_WT)) : tip,
           from.grip + share * (grip - from.grip));
    }
  }
  void step(const Vec3& tip, double grip) {
    const haptic::ToolInput before = bench.input();
    const haptic::ToolOutput felt = bench.output();
    bench.place(0, tip, grip);
    bench.input().frame.q_WT = Eigen::AngleAxisd(roll_, Vec3::UnitZ());
    bench.step();
    const Vec3 turn = haptic::rotation_between(before.frame.q_WT, bench.input().frame.q_WT);
    const haptic::ToolOutput& now = bench.output();
    given_j +=
        0.5 * ((felt.force + now.force).dot(tip - before.frame.p_WT) + (felt.torque + now.torque).dot(turn) +
               (felt.grip_torque + now.grip_torque) * (grip - before.grip));
    put_in_j = std::max(put_in_j, -given_j);
    largest_nm = std::max(largest_nm, now.grip_torque);
  }
  const haptic::ToolOutput& output() const { return bench.output(); }

  Bench bench;
  double given_j = 0, put_in_j = 0, largest_nm = 0;

 private:
  double roll_ = 0;
};

/// Above the block's middle, on it with open jaws, and closed there.
const Vec3 kOverBlock(0.05, 0.05, 0.043), kOnBlock(0.05, 0.05, 0.037);
GraspingHand pinching_with(const haptic::ToolModel& tool) {
  GraspingHand hand(block(), tool);
  hand.go_to(kOverBlock, kJawsOpen_rad, 1);
  hand.go_to(kOnBlock, kJawsOpen_rad, 100);
  hand.go_to(kOnBlock, kJawsShut_rad, 200);
  return hand;
}
GraspingHand pinching_hand() {
  return pinching_with(round_jaws());
}
/// Jaws around the held_flap's edge, closed.
GraspingHand clamping_hand() {
  GraspingHand hand(held_flap(), flat_jaws());
  const Vec3 around = kFreeEdge - Vec3(0, 0, 0.009);
  hand.go_to(kFreeEdge + Vec3(0, 0, 0.01), 0.9, 1);
  hand.go_to(around, 0.9, 200);
  hand.go_to(around, kJawsShut_rad, 800);
  return hand;
}

// ---- geometry

TEST(Jaws, TheyOpenByTheGripAndTheMiddleStays) {
  const haptic::ToolModel tool = round_jaws();
  const Vec3 right(0.002, 0.001, 0.003), up(0, 0, 0.01), mirror(-1, 1, 1);
  for (const double grip : {0.0, 0.3, 1.2}) {
    const auto at = [&](const Vec3& p) { return haptic::at_opening(tool, p, grip); };
    const Vec3 blade = at(right + up) - at(right);
    EXPECT_NEAR(blade.norm(), up.norm(), 1e-12) << "a jaw is rigid";
    EXPECT_NEAR(2 * std::atan2(-blade.x(), blade.z()), grip, 1e-12) << "half of it each";
    EXPECT_LE((at(right.cwiseProduct(mirror)) - at(right).cwiseProduct(mirror)).norm(), 1e-12);
    EXPECT_EQ(at(Vec3::Zero()), Vec3::Zero());
    EXPECT_EQ(at(Vec3(0.002, 0, 0.02)), Vec3(0.002, 0, 0.02)) << "behind the hinge";
  }
  EXPECT_GT(haptic::at_opening(tool, right, 0.3).x(), right.x()) << "positive opens";
}

TEST(Jaws, AProbeHasNone) {
  EXPECT_EQ(haptic::jaw_of(round_tool(), Vec3(0.003, 0, 0)), 0);
}

// ---- what is between them

TEST(Jaws, TissueBetweenThemResistsClosingFromBothSides) {
  for (const auto& make : {pinching_hand, clamping_hand}) {
    GraspingHand hand = make();
    ASSERT_TRUE(hand.output().grasping);
    EXPECT_GT(hand.output().grip_torque, 5e-5);
    double right_n = 0, left_n = 0;
    for (const haptic::ToolContact& contact : hand.bench.state().active()) {
      const double x = hand.bench.model().tools[0].points[static_cast<std::size_t>(contact.point)].x();
      (x > 0 ? right_n : left_n) += contact.force.x();
    }
    EXPECT_LT(right_n, -0.01) << "each jaw presses it towards the other one";
    EXPECT_GT(left_n, 0.01);
    EXPECT_NEAR(hand.output().force.x(), 0, 0.3 * left_n) << "together they push hardly aside";
  }
}

TEST(Jaws, WhatTheyHoldIsBetweenBoth) {
  GraspingHand hand = clamping_hand();
  int right = 0, left = 0;
  for (const haptic::ToolContact& contact : hand.bench.state().active()) {
    if (!contact.grasped) continue;
    const double side = contact.place.normal.x();
    right += side > 0.5, left += side < -0.5;
  }
  EXPECT_GE(right, 2) << "one face of the held_flap";
  EXPECT_GE(left, 2) << "and the other one";
}

TEST(Jaws, TheirTorqueIsTheGradientOfWhatTheTissueStores) {
  constexpr double kStep_rad = 1e-3;
  for (const auto& make : {pinching_hand, clamping_hand}) {
    GraspingHand hand = make();
    const Vec3 tip = hand.bench.input().frame.p_WT;
    const auto stored_j = [&](double grip) {
      for (int i = 0; i < 5; ++i) hand.step(tip, grip);
      return hand.bench.state().energies[0].stored_j;
    };
    const double closed_j = stored_j(kJawsShut_rad - kStep_rad), open_j = stored_j(kJawsShut_rad + kStep_rad);
    stored_j(kJawsShut_rad);
    const double expected_nm = -(open_j - closed_j) / (2 * kStep_rad) * hand.output().share;
    EXPECT_NEAR(hand.output().grip_torque, expected_nm, 0.02 * expected_nm);
  }
}

TEST(Jaws, HoldingAloneIsNoForce) {
  GraspingHand hand(block(), round_jaws());
  hand.go_to(kOverBlock, kJawsOpen_rad, 1);
  hand.go_to(kOnBlock, kJawsOpen_rad, 100);
  hand.go_to(kOnBlock, 0.151, 100);
  const haptic::ToolOutput before = hand.output();
  ASSERT_FALSE(before.grasping);
  hand.step(kOnBlock, 0.149);
  ASSERT_TRUE(hand.output().grasping);
  EXPECT_LE((hand.output().force - before.force).norm(), 0.05 * before.force.norm());
}

TEST(Jaws, ShutAtABlowTheySqueezeNoMoreThanThoseThatCloseSlowly) {
  GraspingHand slow = pinching_hand(), fast(block(), round_jaws());
  fast.go_to(kOverBlock, kJawsOpen_rad, 1);
  fast.go_to(kOnBlock, kJawsOpen_rad, 100);
  for (int i = 0; i < 5; ++i) fast.step(kOnBlock, kJawsShut_rad);
  ASSERT_TRUE(fast.output().grasping);
  EXPECT_GT(fast.output().grip_torque, 0);
  EXPECT_LT(fast.output().grip_torque, slow.output().grip_torque);
}

TEST(Jaws, OpenOrInTheAirTheyFeelNothing) {
  GraspingHand hand = pinching_hand();
  hand.go_to(kOnBlock, kJawsOpen_rad, 50);
  EXPECT_FALSE(hand.output().grasping);
  hand.go_to(kOverBlock + Vec3(0, 0, 0.01), kJawsOpen_rad, 200);
  EXPECT_EQ(hand.output().grip_torque, 0);
  hand.go_to(kOverBlock + Vec3(0, 0, 0.01), kJawsShut_rad, 100);
  EXPECT_FALSE(hand.output().grasping);
  EXPECT_EQ(hand.output().grip_torque, 0);
  EXPECT_EQ(hand.bench.state().tools[0].grasps.empty, 1u) << "jaws that hold nothing say so";
}

TEST(Jaws, ThatAreClosedAndHoldNothingAreABluntProbe) {
  GraspingHand hand(block(), round_jaws());
  hand.go_to(kOverBlock, 0, 1);
  hand.go_to(kOnBlock, 0, 100);
  EXPECT_GT(hand.output().force.z(), 0.2);
  EXPECT_EQ(hand.output().grip_torque, 0);
}

TEST(Jaws, WhatIsPulledHarderThanTheyGripSlipsOut) {
  haptic::ToolModel weak = round_jaws();
  weak.grip_force_n = 0.5;
  GraspingHand hand = pinching_with(weak);
  ASSERT_TRUE(hand.output().grasping);
  double most_n = 0;
  for (int i = 0; i < 400; ++i) {
    hand.step(kOnBlock + Vec3(0, 0, 5e-5 * i), kJawsShut_rad);
    most_n = std::max(most_n, hand.output().pull_n);
  }
  EXPECT_GT(most_n, weak.grip_force_n);
  EXPECT_LT(most_n, weak.grip_force_n + 0.15) << "so far it was pulled on in ten ticks";
  EXPECT_FALSE(hand.output().grasping);
  EXPECT_EQ(hand.output().force, Vec3::Zero());
  EXPECT_EQ(hand.bench.state().tools[0].grasps.torn, 1u);
  hand.go_to(kOnBlock, kJawsShut_rad, 200);
  EXPECT_FALSE(hand.output().grasping) << "until they were open again";
  hand.go_to(kOnBlock, kJawsOpen_rad, 50);
  hand.go_to(kOnBlock, kJawsShut_rad, 50);
  EXPECT_TRUE(hand.output().grasping);
}

TEST(Jaws, PressingDoesNotPullAnythingOut) {
  haptic::ToolModel weak = round_jaws();
  weak.grip_force_n = 0.5;
  GraspingHand hand = pinching_with(weak);
  hand.go_to(kOnBlock - Vec3(0, 0, 0.003), kJawsShut_rad, 100);
  EXPECT_GT(hand.output().force.z(), 2 * weak.grip_force_n);
  EXPECT_TRUE(hand.output().grasping);
}

TEST(HandAccount, APullCountsOnceUntilItHasEasedOff) {
  haptic::HandAccount account;
  msg::ToolForce force{};
  force.force.z = -3;
  const auto pull = [&](double newton, int ticks) {
    for (int i = 0; i < ticks; ++i) account.add(force, newton, 5);
    return account.pulls_beyond_limit;
  };
  EXPECT_EQ(pull(4.9, 100), 0u);
  EXPECT_EQ(pull(7, 5) + pull(4.9, 1), 0u) << "a few ticks are none";
  EXPECT_EQ(pull(6, 100), 1u);
  pull(4.5, 20);
  EXPECT_EQ(pull(6, 20), 1u) << "it trembles at the limit";
  pull(3.9, 1);
  EXPECT_EQ(pull(6, 20), 2u);
  EXPECT_EQ(account.force_max_n, 3);
  EXPECT_EQ(account.pull_max_n, 7);
}

// ---- passivity

TEST(Jaws, ClosingPullingTwistingAndOpeningGiveNoEnergy) {
  for (const auto& make : {pinching_hand, clamping_hand}) {
    GraspingHand hand = make();
    const Vec3 held = hand.bench.input().frame.p_WT;
    const Vec3 away = held.z() > 0.05 ? Vec3(kFreeEdge + Vec3(0, 0, 0.01)) : kOverBlock;
    hand.go_to(held + Vec3(0.002, -0.003, 0.006), kJawsShut_rad, 200);
    hand.go_to(held + Vec3(0.002, 0.003, 0.006), kJawsShut_rad, 200, 0.4);
    hand.go_to(held + Vec3(0, 0, 0.002), 0.1, 200, -0.2);
    hand.go_to(held, kJawsShut_rad, 200);
    const double wide_rad = held.z() > 0.05 ? 0.9 : kJawsOpen_rad;
    hand.go_to(held, wide_rad, 400);
    hand.go_to(away, wide_rad, 200);
    EXPECT_LE(hand.given_j, 0.02 * hand.put_in_j);
    EXPECT_GT(hand.put_in_j, 1e-4);
    EXPECT_EQ(hand.output().force, Vec3::Zero());
  }
}

TEST(Jaws, NoClosedPathOfGripAndPlaceGivesEnergy) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 6; ++trial) {
    GraspingHand hand = pinching_hand();
    const double before_j = hand.given_j;
    for (int leg = 0; leg < 6; ++leg) {
      const Vec3 aside(0.004 * unit(random), 0.004 * unit(random), 0.004 * unit(random));
      hand.go_to(kOnBlock + aside, 0.06 + 0.06 * unit(random), 60, 0.3 * unit(random));
    }
    hand.go_to(kOnBlock, kJawsShut_rad, 60);
    ASSERT_TRUE(hand.output().grasping);
    EXPECT_LE(hand.given_j - before_j, 0.01 * hand.put_in_j) << trial;
  }
}

/// What a hand is given of forces as they leave, and how they step.
struct FeltForces {
  double given_j = 0, most_j = 0, rise_n = 0, rise_nm = 0;
};
FeltForces felt_by(GraspingHand& hand, int ticks, const std::function<void(int)>& step) {
  haptic::ForceSafety safety{haptic::ForceLimits{}};
  FeltForces felt;
  haptic::Wrench last;
  for (int i = 0; i < ticks; ++i) {
    const haptic::ToolInput before = hand.bench.input();
    step(i);
    const haptic::ToolInput& now = hand.bench.input();
    const haptic::ToolOutput& output = hand.output();
    haptic::SafetyInput input;
    input.model = {output.force, output.torque, output.grip_torque};
    input.stored_j = output.stored_j;
    input.tip = now.frame.p_WT;
    input.grip = now.grip;
    input.dt_s = input.way_s = kHandTick_s;
    input.engaged = true;
    felt.given_j +=
        last.force.dot(now.frame.p_WT - before.frame.p_WT) + last.grip_torque * (now.grip - before.grip);
    felt.most_j = std::max(felt.most_j, felt.given_j);
    const haptic::Wrench wrench = safety.pass(input).wrench;
    EXPECT_TRUE(haptic::is_finite(wrench));
    felt.rise_n = std::max(felt.rise_n, wrench.force.norm() - last.force.norm());
    felt.rise_nm = std::max(felt.rise_nm, std::abs(wrench.grip_torque) - std::abs(last.grip_torque));
    last = wrench;
  }
  return felt;
}

TEST(Jaws, ThatChatterEveryTickGiveNoMoreThanTheTanksReserve) {
  GraspingHand hand = pinching_hand();
  const FeltForces felt = felt_by(hand, 3000, [&](int i) {
    hand.step(kOnBlock + Vec3(0, 0, 0.002 * std::sin(0.01 * i)), i % 2 == 0 ? kJawsOpen_rad : kJawsShut_rad);
  });
  EXPECT_LE(felt.most_j, node::EnergyTank::kBound_j);
  const haptic::ForceLimits limits;
  EXPECT_LE(felt.rise_n, limits.max_slew_n_s * kHandTick_s * (1 + 1e-9));
  EXPECT_LE(felt.rise_nm,
            limits.max_slew_n_s * kHandTick_s / limits.max_force_n * limits.max_torque_nm * (1 + 1e-9));
}

// ---- bad input

TEST(Jaws, AGripThatIsNoNumberStopsTheForce) {
  GraspingHand hand = pinching_hand();
  hand.bench.input().grip = std::numeric_limits<double>::quiet_NaN();
  hand.bench.step();
  EXPECT_FALSE(hand.output().force.allFinite()) << "its safety is told";
  EXPECT_FALSE(hand.output().grasping);
  EXPECT_EQ(hand.bench.state().contact_count, 0);
}

TEST(Jaws, GripsBeyondAllBoundsAreThoseOfTheWidestJaws) {
  for (const double grip : {-3.0, 100.0}) {
    GraspingHand hand = pinching_hand();
    hand.step(kOnBlock, grip);
    EXPECT_TRUE(hand.output().force.allFinite());
    EXPECT_EQ(hand.bench.state().tools[0].grip, std::clamp(grip, 0.0, haptic::kWidest_rad));
  }
}

}  // namespace
}  // namespace omentum::haptic_test
