#include "haptic_node/force_safety.h"

#include "haptic_fixtures.h"

#include <limits>

namespace omentum::haptic_test {
namespace {

using haptic::ForceLimits;
using haptic::ForceSafety;
using haptic::SafeForce;
using haptic::SafetyInput;
using haptic::Wrench;
using node::EnergyTank;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTick_s = 1e-3;
constexpr double kRounding_n = 1e-9;

Wrench force_z(double newton) {
  return {Vec3(0, 0, newton), Vec3::Zero()};
}

// ---- pure filters

TEST(ForceFilters, ClampKeepsTheDirection) {
  Wrench w{Vec3(30, 40, 0), Vec3(0, 0, 2)};
  EXPECT_TRUE(haptic::clamp_wrench(w, 10, 0.5));
  EXPECT_LE((w.force - Vec3(6, 8, 0)).norm(), kRounding_n);
  EXPECT_LE((w.torque - Vec3(0, 0, 0.5)).norm(), kRounding_n);
}

TEST(ForceFilters, WithinLimitsNothingChanges) {
  const Wrench w{Vec3(1, 2, 3), Vec3(0.1, 0, 0)};
  Wrench clamped = w, slewed = w;
  EXPECT_FALSE(haptic::clamp_wrench(clamped, 10, 0.5));
  EXPECT_EQ(clamped.force, w.force);
  EXPECT_FALSE(haptic::slew_wrench(slewed, {Vec3(1, 2, 2), Vec3(0.1, 0, 0)}, {}, kTick_s));
  EXPECT_EQ(slewed.force, w.force);
}

TEST(ForceFilters, SlewGoesStraightTowardsTheTarget) {
  Wrench w = force_z(10);
  EXPECT_TRUE(haptic::slew_wrench(w, {Vec3(0, 0, 0), Vec3::Zero()}, ForceLimits{}, kTick_s));
  EXPECT_LE((w.force - Vec3(0, 0, 2)).norm(), kRounding_n);
}

TEST(ForceFilters, FadeTakesItsTimeWhateverTheRate) {
  for (const double dt : {1e-3, 1.0 / 300, 0.01}) {
    double gain = 0, up = 0, down = 0;
    for (; gain < 1; up += dt) gain = haptic::fade(gain, true, {}, dt);
    for (; gain > 0; down += dt) gain = haptic::fade(gain, false, {}, dt);
    EXPECT_NEAR(up, ForceLimits{}.ramp_s, dt + 1e-9);
    EXPECT_NEAR(down, ForceLimits{}.decay_s, dt + 1e-9);
  }
}

// ---- the exit, on given times

SafetyInput fresh(const Wrench& model) {
  SafetyInput input;
  input.model = model;
  input.dt_s = kTick_s;
  input.way_s = kTick_s;
  input.engaged = true;
  return input;
}

ForceSafety ramped_up(ForceLimits limits = {}) {
  ForceSafety safety(limits);
  for (int i = 0; i < 300; ++i) static_cast<void>(safety.pass(fresh({})));
  return safety;
}

TEST(ForceSafety, WhenNothingActsTheModelsForceLeavesUnchanged) {
  ForceSafety safety = ramped_up();
  const Wrench model{Vec3(0.123456789, -0.4, 0.987), Vec3(0.001, 0.002, -0.0001)};
  const SafeForce out = safety.pass(fresh(model));
  EXPECT_EQ(out.state, 0u);
  EXPECT_EQ(out.wrench.force, model.force);
  EXPECT_EQ(out.wrench.torque, model.torque);
}

TEST(ForceSafety, NotANumberLatchesUntilSomebodyClearsIt) {
  for (int component = 0; component < 7; ++component) {
    ForceSafety safety = ramped_up();
    Wrench bad = force_z(1);
    (component == 6 ? bad.grip_torque : (component < 3 ? bad.force : bad.torque)[component % 3]) = kNan;
    SafeForce out = safety.pass(fresh(bad));
    EXPECT_TRUE(out.state & msg::FORCE_FAULT);
    EXPECT_EQ(out.wrench.force, Vec3::Zero());
    EXPECT_EQ(out.wrench.grip_torque, 0);
    for (int i = 0; i < 1000; ++i) out = safety.pass(fresh(force_z(1)));
    EXPECT_EQ(out.wrench.force, Vec3::Zero()) << "good forces do not unlatch";
    safety.clear_fault();
    out = safety.pass(fresh(force_z(1)));
    EXPECT_EQ(out.state, msg::FORCE_RAMP);
    EXPECT_LT(out.wrench.force.z(), 0.02) << "it fades in";
  }
}

TEST(ForceSafety, TheSmallerOfSceneAndDeviceLimitsCounts) {
  ForceSafety safety = ramped_up({.max_force_n = 10, .max_slew_n_s = 1e9});
  EXPECT_NEAR(safety.pass(fresh(force_z(50))).wrench.force.z(), 10, kRounding_n);
  safety.set_device({.max_force_n = 3.3, .max_torque_nm = 0.1});
  const SafeForce out = safety.pass(fresh({Vec3(0, 0, 50), Vec3(1, 0, 0)}));
  EXPECT_TRUE(out.state & msg::FORCE_CLAMPED);
  EXPECT_NEAR(out.wrench.force.z(), 3.3, kRounding_n);
  EXPECT_NEAR(out.wrench.torque.x(), 0.1, kRounding_n);
  safety.set_device({.max_force_n = 0, .max_torque_nm = 0});
  EXPECT_EQ(safety.pass(fresh(force_z(50))).wrench.force, Vec3::Zero()) << "none may be asked for";
}

TEST(ForceSafety, AxesWithoutAMotorGetNothing) {
  ForceSafety safety{ForceLimits{}};
  safety.set_device({.actuated_axes = msg::AXIS_X | msg::AXIS_Z | msg::AXIS_ROLL});
  SafetyInput input = fresh({Vec3(1, 1, 1), Vec3(0.1, 0.1, 0.1)});
  input.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()));  // the shaft is along x
  for (int i = 0; i < 300; ++i) static_cast<void>(safety.pass(input));
  const SafeForce out = safety.pass(input);
  EXPECT_LE((out.wrench.force - Vec3(1, 0, 1)).norm(), kRounding_n);
  EXPECT_LE((out.wrench.torque - Vec3(0.1, 0, 0)).norm(), kRounding_n);
  safety.set_device({.actuated_axes = msg::AXIS_GRIP});
  EXPECT_LE(safety.pass(input).wrench.torque.norm(), kRounding_n);
}

// ---- the jaws' torque

Wrench on_jaws(double nm) {
  return {Vec3::Zero(), Vec3::Zero(), nm};
}

TEST(GripTorque, IsTheModelsWhereNothingActsAndNoneWithoutAMotor) {
  ForceSafety safety = ramped_up();
  const SafeForce out = safety.pass(fresh(on_jaws(0.0123)));
  EXPECT_EQ(out.state, 0u);
  EXPECT_EQ(out.wrench.grip_torque, 0.0123);
  safety.set_device({.actuated_axes = msg::AXIS_X | msg::AXIS_Y | msg::AXIS_Z});
  EXPECT_EQ(safety.pass(fresh(on_jaws(0.0123))).wrench.grip_torque, 0);
}

TEST(GripTorque, HasTheLimitAndTheSlewOfATorque) {
  for (const double sign : {-1.0, 1.0}) {
    ForceSafety safety = ramped_up();
    double last_nm = 0;
    for (int i = 0; i < 100; ++i) {
      const SafeForce out = safety.pass(fresh(on_jaws(sign * 3)));
      EXPECT_LE(std::abs(out.wrench.grip_torque - last_nm), 0.1 + kRounding_n) << "0.5 N m in 5 ms";
      EXPECT_TRUE(out.state & msg::FORCE_CLAMPED);
      last_nm = out.wrench.grip_torque;
    }
    EXPECT_NEAR(last_nm, sign * ForceLimits{}.max_torque_nm, kRounding_n);
    safety.set_device({.max_torque_nm = 0.02});
    for (int i = 0; i < 10; ++i) last_nm = safety.pass(fresh(on_jaws(sign * 3))).wrench.grip_torque;
    EXPECT_NEAR(last_nm, sign * 0.02, kRounding_n);
  }
}

TEST(GripTorque, FadesInAndDecaysWithTheForce) {
  ForceSafety safety{ForceLimits{}};
  EXPECT_LT(safety.pass(fresh(on_jaws(0.1))).wrench.grip_torque, 0.001) << "fades in";
  for (int i = 0; i < 300; ++i) static_cast<void>(safety.pass(fresh(on_jaws(0.1))));
  SafetyInput stale = fresh(on_jaws(0.1));
  stale.way_s = 0;
  for (int ms = 6; ms <= 40; ++ms) {
    stale.pose_age_s = 1e-3 * ms;
    const SafeForce out = safety.pass(stale);
    EXPECT_TRUE(out.state & msg::FORCE_STALE);
    if (ms > 25) {
      EXPECT_EQ(out.wrench.grip_torque, 0) << ms;
    }
  }
}

// A source in the model: it opens the jaws whichever way they go.
TEST(GripTorque, GivesJawsThatOpenAndCloseNoMoreThanTheTankCovers) {
  ForceSafety safety = ramped_up();
  double given_j = 0, most_j = 0, last_nm = 0, grip = 0;
  for (int i = 0; i < 5000; ++i) {
    const double before = grip;
    grip = 0.3 + 0.3 * std::sin(0.05 * i);
    SafetyInput input = fresh(on_jaws(grip > before ? 0.3 : 0));
    input.grip = grip;
    given_j += last_nm * (grip - before);
    most_j = std::max(most_j, given_j);
    last_nm = safety.pass(input).wrench.grip_torque;
  }
  EXPECT_LE(most_j, EnergyTank::kBound_j);
  EXPECT_GT(most_j, 0.2 * EnergyTank::kReserve_j) << "there was something to hold back";
}

TEST(ForceSafety, AStallIsNoReasonToStep) {
  ForceSafety safety = ramped_up();
  SafetyInput late = fresh(force_z(10));
  late.dt_s = 0.02;
  EXPECT_LE(safety.pass(late).wrench.force.z(), 2 + kRounding_n) << "one nominal period of 2 N";
}

// At 300 Hz two nominal periods would have been the whole limit.
TEST(ForceSafety, AfterAStallNoTickStepsFartherThanANominalOne) {
  for (const double rate_hz : {300.0, 500.0, 1000.0, 4000.0}) {
    const ForceLimits limits{.period_s = 1 / rate_hz};
    for (const double stall_s : {0.003, 0.005, 0.02}) {
      ForceSafety safety = ramped_up(limits);
      SafetyInput late = fresh(force_z(limits.max_force_n));
      late.dt_s = stall_s;
      EXPECT_LE(safety.pass(late).wrench.force.z(), limits.max_slew_n_s / rate_hz + kRounding_n)
          << rate_hz << " Hz, " << stall_s << " s";
    }
  }
}

TEST(ForceSafety, StepsAreSlewed) {
  ForceSafety safety = ramped_up();
  for (int i = 1; i <= 4; ++i) {
    const SafeForce out = safety.pass(fresh(force_z(8)));
    EXPECT_NEAR(out.wrench.force.z(), 2.0 * i, kRounding_n);
    EXPECT_EQ((out.state & msg::FORCE_SLEW) != 0, i < 4);
  }
}

TEST(ForceSafety, EngagingFadesIn) {
  ForceSafety safety{ForceLimits{}};
  double before = 0;
  int ticks = 0;
  for (SafeForce out; ticks == 0 || out.state != 0; ++ticks) {
    out = safety.pass(fresh(force_z(5)));
    EXPECT_LE(out.wrench.force.z() - before, 5 * kTick_s / ForceLimits{}.ramp_s + kRounding_n);
    before = out.wrench.force.z();
    ASSERT_LT(ticks, 1000);
  }
  EXPECT_NEAR(ticks * kTick_s, ForceLimits{}.ramp_s, 2 * kTick_s);
}

TEST(ForceSafety, AStalePoseDecaysToZeroInTime) {
  for (const double slew : {2000.0, 50.0}) {  // a slow slew limit must not hold the force up
    ForceSafety safety = ramped_up({.max_slew_n_s = slew});
    for (int i = 0; i < 300; ++i) static_cast<void>(safety.pass(fresh(force_z(8))));
    SafetyInput input = fresh(force_z(8));
    double before = 8;
    for (; input.pose_age_s < 0.030; input.pose_age_s += kTick_s) {
      const SafeForce out = safety.pass(input);
      EXPECT_LE(out.wrench.force.z(), before + kRounding_n);
      EXPECT_EQ((out.state & msg::FORCE_STALE) != 0, input.pose_age_s > 0.005);
      if (input.pose_age_s <= 0.005) {
        EXPECT_EQ(out.wrench.force.z(), 8);
      } else if (input.pose_age_s >= 0.0250001) {
        EXPECT_EQ(out.wrench.force, Vec3::Zero());
      }
      before = out.wrench.force.z();
    }
    // back again: it fades in
    EXPECT_LE(safety.pass(fresh(force_z(8))).wrench.force.z(), 8 * kTick_s / 0.2 + kRounding_n);
  }
}

TEST(ForceSafety, OneLateTickDoesNotStretchTheDecay) {
  ForceSafety safety = ramped_up();
  for (int i = 0; i < 10; ++i) static_cast<void>(safety.pass(fresh(force_z(8))));
  SafetyInput late = fresh(force_z(8));
  late.pose_age_s = 0.1;
  late.dt_s = 0.001;
  EXPECT_EQ(safety.pass(late).wrench.force, Vec3::Zero());
}

TEST(ForceSafety, PauseDecaysAndStartFadesIn) {
  for (const double slew : {2000.0, 50.0}) {  // a slow slew limit must not hold the force up
    ForceSafety safety = ramped_up({.max_slew_n_s = slew});
    for (int i = 0; i < 300; ++i) static_cast<void>(safety.pass(fresh(force_z(8))));
    SafetyInput input = fresh(force_z(8));
    input.paused = true;
    const double step = kTick_s / ForceLimits{}.decay_s;
    double before = 8;
    for (double t = kTick_s; t < 0.03; t += kTick_s) {
      const SafeForce out = safety.pass(input);
      EXPECT_TRUE(out.state & msg::FORCE_PAUSED);
      EXPECT_LE(out.wrench.force.z(), before);
      if (slew > 1000) {
        EXPECT_GE(out.wrench.force.z(), before - 8 * step - kRounding_n) << "no step";
      }
      if (t > ForceLimits{}.decay_s + kTick_s / 2) {
        EXPECT_EQ(out.wrench.force, Vec3::Zero());
      }
      before = out.wrench.force.z();
    }
    input.paused = false;
    const SafeForce out = safety.pass(input);
    EXPECT_TRUE(out.state & msg::FORCE_RAMP);
    EXPECT_LE(out.wrench.force.z(), 8 * kTick_s / 0.2 + kRounding_n);
  }
}

TEST(ForceSafety, ReconnectingFadesIn) {
  ForceSafety safety = ramped_up();
  SafetyInput input = fresh(force_z(2));
  input.reconnected = true;
  EXPECT_LE(safety.pass(input).wrench.force.z(), 2 * kTick_s / 0.2 + kRounding_n);
}

// An active environment: a force along the motion, which feeds the hand without end.
TEST(ForceSafety, ASourceGivesNoMoreThanTheBoundAndIsToldAsPassivity) {
  for (const double source_n_s_m : {12.0, 50.0, 500.0, 1e5}) {
    for (const double speed_m_s : {0.05, 0.5}) {
      ForceSafety safety = ramped_up();
      Vec3 tip = Vec3::Zero();
      double most_j = 0;
      std::uint32_t seen = 0;
      for (int i = 0; i < 20'000; ++i) {
        const Vec3 velocity(speed_m_s * std::cos(2 * M_PI * 8 * i * kTick_s), 0, 0);
        tip += kTick_s * velocity;
        SafetyInput input = fresh({source_n_s_m * velocity, Vec3::Zero()});
        input.tip = tip;
        seen |= safety.pass(input).state;
        most_j = std::max(most_j, safety.tank().given_j());
      }
      EXPECT_LE(most_j, EnergyTank::kBound_j) << source_n_s_m << " N s/m at " << speed_m_s << " m/s";
      EXPECT_TRUE(seen & msg::FORCE_PASSIVITY);
    }
  }
}

TEST(ForceSafety, AfterASourceTheHandIsNotInMudForMinutes) {
  ForceSafety safety = ramped_up();
  SafetyInput input = fresh(force_z(10));
  for (int i = 0; i < 1000; ++i) {  // 0.1 m/s along 10 N: 1 J, if nobody cut it
    input.tip.z() += 1e-4;
    static_cast<void>(safety.pass(input));
  }
  EXPECT_LT(safety.share(), 1);
  SafeForce out;
  for (int i = 0; i < 3000; ++i) {  // a hand that moves at 5 cm/s
    input = fresh(force_z(0));
    input.tip.x() = 0.01 * std::sin(5 * i * kTick_s);
    input.reconnected = i == 0;
    out = safety.pass(input);
  }
  EXPECT_EQ(out.state, 0u);
  EXPECT_EQ(safety.share(), 1);
}

// A device of 100 Hz in a loop of 1 kHz: the hand's speed is that of its poses, not of the ticks. In the air
// it is not braked.
TEST(ForceSafety, ASlowDevicesHandIsDampedByItsOwnSpeedWhereThereIsTissue) {
  constexpr double kTouch_n = 1e-3;
  ForceSafety safety = ramped_up();
  constexpr double kSpeed_m_s = 0.1, kInterval_s = 0.01;
  SafetyInput input = fresh(force_z(0));
  double largest_n = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool pose = i % 10 == 0;
    input.pose_interval_s = kInterval_s;
    input.way_s = pose ? kInterval_s : 0;
    if (pose) input.tip.z() += kSpeed_m_s * kInterval_s;
    input.model = force_z(i < 1000 ? 3 : i < 2000 ? kTouch_n : 0);  // along the way: 3 N x 10 cm
    const SafeForce out = safety.pass(input);
    if (i >= 2000) {
      EXPECT_EQ(out.wrench.force, Vec3::Zero());
    }
    if (i >= 1000) largest_n = std::max(largest_n, out.wrench.force.norm());
  }
  EXPECT_GT(largest_n, kTouch_n);
  EXPECT_LE(largest_n, EnergyTank::kMaxDamping_n_s_m * kSpeed_m_s + kTouch_n + kRounding_n);
}

TEST(ForceSafety, AnAnswerThatWasNotWrittenDoesNoWork) {
  ForceSafety safety = ramped_up();
  SafetyInput input = fresh(force_z(1));
  input.written = false;
  for (int i = 0; i < 100; ++i) {
    input.tip.z() += 1e-4;
    static_cast<void>(safety.pass(input));
  }
  EXPECT_EQ(safety.tank().given_j(), 0);
}

TEST(ForceSafety, ASpringIsPassiveAndStaysUntouched) {
  ForceSafety safety = ramped_up();
  constexpr double kStiffness = 400;
  for (int i = 0; i < 5000; ++i) {
    const double depth = 0.005 * (1 - std::cos(2 * M_PI * 1.5 * i * kTick_s));
    SafetyInput input = fresh(force_z(kStiffness * depth));
    input.tip = Vec3(0, 0, -depth);
    input.stored_j = 0.5 * kStiffness * depth * depth;
    ASSERT_EQ(safety.pass(input).state, 0u) << "tick " << i;
  }
}

}  // namespace
}  // namespace omentum::haptic_test
