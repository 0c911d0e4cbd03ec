// Force safety through a tool's line and the real step, with an injected clock.
#include "haptic_node/tool_line.h"

#include "haptic_fixtures.h"
#include "haptic_node/jaws.h"

#include <limits>
#include <optional>
#include <random>

namespace omentum::haptic_test {
namespace {

using haptic::ForceLimits;
using haptic::ForceSafety;
using haptic::SafeForce;
using haptic::SafetyInput;
using haptic::ToolLine;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTick_s = 1e-3;
constexpr double kRounding_n = 1e-9;
// What a contact that was given 20 ticks still creeps, relative.
constexpr double kSettled = 1e-4;

constexpr std::int64_t kMs = 1'000'000;

double newton(const msg::ToolForce& f) {
  return std::hypot(f.force.x, f.force.y, f.force.z);
}

class LineBench {
 public:
  LineBench() : bench_(make_model(block(), {round_tool()})), line_(0, {}, faults_) {}

  static msg::ToolPose pose_at(const Vec3& tip, std::uint64_t seq) {
    msg::ToolPose pose{};
    pose.seq = seq;
    pose.stamp_ns = static_cast<std::int64_t>(seq) * kMs;
    pose.valid = true;
    pose.position = {.x = tip.x(), .y = tip.y(), .z = tip.z()};
    pose.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
    return pose;
  }

  bool hear(const msg::ToolPose& pose) { return line_.hear(pose, now_ns_); }
  /// One period later: what leaves.
  const msg::ToolForce& tick(bool paused = false) {
    now_ns_ += kMs;
    line_.listen(now_ns_, bench_.input());
    bench_.step();
    line_.answer(bench_.output(), now_ns_, kTick_s, paused);
    const msg::ToolForce& force = line_.to_send(++ticks_);
    line_.sent(true);
    return force;
  }
  /// A device that sends every `ticks` ms, through one of its intervals: the last answer.
  const msg::ToolForce& press_slowly(const Vec3& tip, int ticks) {
    msg::ToolPose pose = pose_at(tip, ++seq_);
    pose.stamp_ns = now_ns_ + kMs;
    hear(pose);
    for (int i = 1; i < ticks; ++i) tick();
    return tick();
  }
  /// A good sample, then a tick.
  const msg::ToolForce& press(const Vec3& tip) {
    hear(pose_at(tip, ++seq_));
    return tick();
  }
  /// Engaged, faded in, pressing by 8 mm, and settled.
  const msg::ToolForce& press_deep() {
    for (int i = 0; i < 300; ++i) press({0.05, 0.05, 0.045});
    for (int i = 0; i < 129; ++i) press({0.05, 0.05, 0.045 - 0.0001 * i});
    for (int i = 0; i < 20; ++i) press({0.05, 0.05, 0.032});
    return press({0.05, 0.05, 0.032});
  }
  /// The process is stopped for so long: no tick, no arrival.
  void stand_still(int ms) { now_ns_ += ms * kMs; }
  std::uint64_t next_seq() { return ++seq_; }
  ToolLine& line() { return line_; }
  Bench& bench() { return bench_; }
  runtime::FaultList& faults() { return faults_; }

 private:
  Bench bench_;
  runtime::FaultList faults_;
  ToolLine line_;
  std::int64_t now_ns_ = kMs;
  std::uint64_t seq_ = 0, ticks_ = 0;
};

/// Two tools' lines and their common step. A tool without a place is silent.
class TwoTools {
 public:
  TwoTools() : bench_(make_model(block(), {round_tool(), round_tool()})) {}

  /// The force on the second tool, N.
  double tick(const std::optional<Vec3>& first, const std::optional<Vec3>& second) {
    now_ns_ += kMs;
    if (first) hear(0, *first);
    if (second) hear(1, *second);
    for (std::size_t i = 0; i < 2; ++i) lines_[i].listen(now_ns_, bench_.input(i));
    bench_.step();
    double felt_n = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      lines_[i].answer(bench_.output(i), now_ns_, kTick_s, false);
      felt_n = newton(lines_[i].to_send(++ticks_));
      lines_[i].sent(true);
    }
    return felt_n;
  }

 private:
  void hear(std::size_t tool, const Vec3& tip) {
    msg::ToolPose pose = LineBench::pose_at(tip, ++seq_);
    pose.stamp_ns = now_ns_;
    lines_[tool].hear(pose, now_ns_);
  }

  Bench bench_;
  runtime::FaultList faults_;
  std::array<ToolLine, 2> lines_{ToolLine{0, {}, faults_}, ToolLine{1, {}, faults_}};
  std::int64_t now_ns_ = 0;
  std::uint64_t seq_ = 0, ticks_ = 0;
};

TEST(ToolLine, JawsOpenNoWiderThanTheyCanWhateverADeviceSays) {
  LineBench bench;
  for (const double grip : {0.3, 1e306, 57.3, -1000.0}) {
    msg::ToolPose pose = LineBench::pose_at({0.05, 0.05, 0.045}, bench.next_seq());
    pose.grip = grip;
    bench.hear(pose);
    bench.tick();
    EXPECT_EQ(bench.bench().input().grip, std::clamp(grip, 0.0, haptic::kWidest_rad));
    EXPECT_TRUE(std::isfinite(bench.line().safety().tank().given_j()));
  }
}

TEST(SafetyThroughTheStep, ThePressedForceIsTheModelsOwn) {
  LineBench line;
  const msg::ToolForce& force = line.press_deep();
  EXPECT_EQ(force.state, 0u);
  EXPECT_EQ(Vec3(force.force.x, force.force.y, force.force.z), line.bench().output().force);
  EXPECT_GT(newton(force), 0.3);
}

TEST(SafetyThroughTheStep, AHiccupLosesForceAndGetsItBackGently) {
  LineBench line;
  const double pressed = newton(line.press_deep());
  for (int i = 0; i < 15; ++i) line.tick();
  const double left = newton(line.tick());
  EXPECT_GT(left, 0);
  EXPECT_LT(left, pressed);
  const Vec3 tip(0.05, 0.05, 0.032);
  EXPECT_LT(newton(line.press(tip)), left + 0.02 * pressed);
  for (int i = 0; i < 250; ++i) line.press(tip);
  EXPECT_NEAR(newton(line.press(tip)), pressed, 0.02 * pressed);
}

TEST(SafetyThroughTheStep, AHiccupShorterThanStaleChangesNothing) {
  LineBench line, steady;
  line.press_deep();
  steady.press_deep();
  for (int i = 0; i < 4; ++i) line.tick();
  const msg::ToolForce& after = line.press({0.05, 0.05, 0.032});
  EXPECT_EQ(after.state, 0u);
  for (int i = 0; i < 4; ++i) steady.press({0.05, 0.05, 0.032});
  EXPECT_NEAR(newton(after), newton(steady.press({0.05, 0.05, 0.032})), kSettled);
}

// A loop that stood still saw no silence; poses that come after one are a tool that appears all the same.
TEST(SafetyThroughTheStep, AfterASilenceTheToolAppearsWhereItIs) {
  for (const bool loop_stood : {false, true}) {
    LineBench line;
    const double pressed = newton(line.press_deep());
    if (loop_stood) line.stand_still(200);
    for (int i = 0; i < 26 && !loop_stood; ++i) line.tick();
    if (!loop_stood) {
      EXPECT_EQ(newton(line.tick()), 0);
      EXPECT_EQ(line.bench().state().contact_count, 0) << "its dent went with its force";
      EXPECT_TRUE(line.line().is_told());
    }
    const Vec3 tip(0.05, 0.05, 0.032);
    for (int i = 0; i < 300; ++i) {
      ASSERT_LE(newton(line.press(tip)), kSettled * pressed) << "it is not pushed out, " << i;
    }
    for (int i = 0; i < 40; ++i) line.press(tip - Vec3(0, 0, 1e-4 * i));
    EXPECT_GT(newton(line.press(tip - Vec3(0, 0, 4e-3))), 0.1 * pressed) << "it is held back";
  }
}

// One tool presses and dies, and at once the other presses the same place: the dent must not be in its way.
TEST(SafetyThroughTheStep, ADeadToolsDentIsGoneWithItsForce) {
  const Vec3 above(0.05, 0.05, 0.045), below(0.05, 0.05, 0.032);
  constexpr int kPress = 150, kSilence = 26;
  const auto felt = [&](bool pressed_before) {
    TwoTools tools;
    for (int i = 0; i < 600; ++i) {
      const double share = pressed_before ? std::clamp((i - 300) / 200.0, 0.0, 1.0) : 0;
      tools.tick(above + share * (below - above), above);
    }
    for (int i = 0; i < kSilence; ++i) tools.tick(std::nullopt, above);
    double felt_n = 0;
    for (int i = 0; i <= kPress + 50; ++i) {
      const double share = std::min(1.0, static_cast<double>(i) / kPress);
      felt_n = tools.tick(std::nullopt, above + share * (below - above));
    }
    return felt_n;
  };
  const double free_n = felt(false);
  ASSERT_GT(free_n, 0.3);
  EXPECT_NEAR(felt(true), free_n, 0.01 * free_n);
}

// Energy is counted over the way: ten times longer steps, of 0.26 mm, show in the share that is felt.
constexpr double kLongSteps = 0.03;

// 100 poses a second against a loop of 1 kHz: the same force, steadily; and silence is noticed in time.
TEST(SafetyThroughTheStep, ASlowDeviceFeelsTheSameSteadyForce) {
  LineBench fast;
  const double pressed = newton(fast.press_deep());
  for (const int interval : {2, 5, 10}) {
    LineBench line;
    const Vec3 above(0.05, 0.05, 0.045), below(0.05, 0.05, 0.032);
    for (int t = 0; t < 500; t += interval) line.press_slowly(above, interval);
    for (int t = 0; t < 500; t += interval) line.press_slowly(above + t / 500.0 * (below - above), interval);
    for (int t = 0; t < 500; t += interval) line.press_slowly(below, interval);
    for (int i = 0; i < 20; ++i) {
      const msg::ToolForce& force = line.press_slowly(below, interval);
      EXPECT_EQ(force.state, 0u) << "every " << interval << " ms";
      EXPECT_NEAR(newton(force), pressed, kLongSteps * pressed);
      EXPECT_GE(force.valid_for_s, 2e-3 * interval);
      EXPECT_LE(force.valid_for_s, haptic::kLongestStale_s);
    }
    int silent = interval;
    while (newton(line.tick()) > 0 && silent < 1000) ++silent;
    EXPECT_LE(silent * kTick_s, haptic::kLongestStale_s + ForceLimits{}.decay_s + 2 * kTick_s);
  }
}

TEST(PoseInterval, IsTheMedianAndBurstsAndGapsDoNotCount) {
  haptic::PoseInterval interval;
  interval.restart(0);
  EXPECT_EQ(interval.seconds(), 0) << "nothing is known yet";
  std::int64_t now_ns = 0;
  for (int i = 0; i < 100; ++i) {
    now_ns += i % 5 == 0 ? 300 * kMs : i % 5 == 1 ? 1 : 10 * kMs;
    interval.add(now_ns);
    if (i <= 9) continue;
    EXPECT_EQ(interval.seconds(), 0.010);
  }
  for (int i = 0; i < 5; ++i) interval.add(now_ns += 2 * kMs);
  EXPECT_EQ(interval.seconds(), 0.002) << "five poses tell a new rate";
}

TEST(SafetyThroughTheStep, ASampleThatSaysItIsNoneIsCountedAndNoFault) {
  LineBench line;
  line.press({0.05, 0.05, 0.05});
  msg::ToolPose none = LineBench::pose_at({0.05, 0.05, 0.05}, 2);
  none.valid = false;
  EXPECT_FALSE(line.hear(none));
  EXPECT_EQ(line.line().counts().refused, 1u);
  EXPECT_FALSE(line.faults().any());
}

// The held underside of the block has no compliance of its own: the device's stiffness is felt, tick by tick.
TEST(SafetyThroughTheStep, TheHeldBackOfAnOrganIsAsStiffAsTheDevice) {
  constexpr double kStiffness = 1000, kStep_m = 1e-4;
  LineBench line;
  msg::DeviceInfo info{};
  info.max_force_n = 20;
  info.max_torque_nm = 1;
  info.max_stiffness_n_m = kStiffness;
  line.line().hear(info);
  double before = 0, largest = 0;
  for (int i = 0; i < 400; ++i) line.press({0.05, 0.05, -0.01});
  for (int i = 0; i < 100; ++i) {
    line.press({0.05, 0.05, -0.01 + i * kStep_m});
    const double now = line.bench().output().force.norm();
    EXPECT_LE(std::abs(now - before), 1.01 * kStiffness * kStep_m + kRounding_n) << "tick " << i;
    before = now;
    largest = std::max(largest, now);
  }
  EXPECT_GT(largest, 1) << "it was touched";
}

TEST(SafetyThroughTheStep, ADevicesNonsenseIsAFault) {
  LineBench line;
  msg::DeviceInfo info{};
  info.max_force_n = kNan;
  info.max_stiffness_n_m = 5e-324;
  for (int i = 0; i < 3; ++i) line.line().hear(info);
  info.max_force_n = -1;
  line.line().hear(info);
  const auto faults = line.faults().list();
  ASSERT_EQ(faults.size(), 2u) << "one for each field, whatever comes";
  EXPECT_EQ(faults[0].text, "tool 0: DeviceInfo.max_force_n = nan, expected 0 to 1000; the last one holds");
  EXPECT_EQ(faults[0].count, 4u);
  EXPECT_NE(faults[1].text.find("max_stiffness_n_m = 4.9"), std::string::npos) << faults[1].text;
  EXPECT_LT(faults[1].text.size(), runtime::FaultList::kTextSize);
}

TEST(SafetyThroughTheStep, ADeadDeviceLetsTheTissueGo) {
  LineBench line;
  line.press_deep();
  for (int i = 0; i < 1100; ++i) line.tick();
  EXPECT_FALSE(line.line().engaged());
  EXPECT_EQ(line.bench().state().contact_count, 0);
}

// Whatever comes on the topic, as long as it is no good sample, the hand feels the decay and then nothing.
TEST(SafetyThroughTheStep, RubbishNeverReachesTheHand) {
  std::mt19937 random(1);
  LineBench line;
  double allowed = newton(line.press_deep());
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    const std::uint64_t seq = line.next_seq();
    msg::ToolPose p = LineBench::pose_at({0.05, 0.05, 0.032}, seq);
    switch (random() % 6) {
      case 0:
        p.position.x = kNan;
        break;
      case 1:
        p.orientation.y = std::numeric_limits<double>::infinity();
        break;
      case 2:
        p.position.z = 1000 * unit(random) + 2000;
        break;
      case 3:
        p.valid = false;
        break;
      case 4:
        p.seq = 3;
        break;
      default:
        p.orientation.w = 1.5 + unit(random);
        p.orientation.x = 1;
        break;
    }
    EXPECT_FALSE(line.hear(p));
    const msg::ToolForce& force = line.tick();
    ASSERT_TRUE(std::isfinite(newton(force)));
    ASSERT_LE(newton(force), allowed * (1 + kSettled)) << "tick " << i;
    ASSERT_TRUE(i <= 26 || newton(force) == 0) << "tick " << i;
    EXPECT_FALSE(force.state & msg::FORCE_FAULT) << "the node itself is well";
  }
  EXPECT_EQ(line.line().counts().refused, 3000u);
  EXPECT_TRUE(line.faults().any());
}

TEST(SafetyThroughTheStep, APersistentNewPlaceIsTakenUpWithARamp) {
  LineBench line;
  line.press_deep();
  const Vec3 elsewhere(0.02, 0.08, 0.2);
  double largest = 0;
  for (int i = 0; i < 100; ++i) {
    const msg::ToolForce& force = line.press(elsewhere);
    if (i > 30) largest = std::max(largest, newton(force));
  }
  EXPECT_EQ(largest, 0);
  EXPECT_TRUE(line.line().engaged());
  EXPECT_EQ(line.bench().state().contact_count, 0) << "it did not sweep there";
}

TEST(SafetyThroughTheStep, EchoesThePoseThatItAnswers) {
  LineBench line;
  const msg::ToolForce& force = line.press({0.05, 0.05, 0.05});
  EXPECT_EQ(force.echo_seq, 1u);
  EXPECT_EQ(force.echo_stamp_ns, kMs);
  EXPECT_GT(force.valid_for_s, 0);
}

TEST(SafetyThroughTheStep, SequenceNumbersCountWhatIsSent) {
  runtime::FaultList faults;
  ToolLine line(0, {}, faults);
  for (int i = 0; i < 3; ++i) line.answer({}, i * kMs, kTick_s, false);
  EXPECT_EQ(line.to_send(7).seq, 1u);
  line.answer({}, 4 * kMs, kTick_s, false);
  const msg::ToolForce& next = line.to_send(12);
  EXPECT_EQ(next.seq, 2u);
  EXPECT_EQ(next.tick, 12u);
}

// A hand of 200 g on a spring and a damper, pressing, holding, sliding and letting go through the real step
// and safety.
struct HandRun {
  double held_n = 0;  // mean force in the hold
  double given_j = 0;
  double largest_step_n = 0;
  std::uint32_t acted = 0;  // safety bits after the first fade-in
};

HandRun run_hand(double rate_hz, double friction) {
  constexpr double kMass = 0.2, kStiffness = 400, kDamping = 12;
  constexpr int kSubsteps = 20;
  const double dt = 1 / rate_hz;
  Bench bench(make_model(block(), {round_tool()}, friction));
  ForceSafety safety{ForceLimits{}};
  HandRun run;
  Vec3 x(0.035, 0.05, 0.045), v = Vec3::Zero(), before = Vec3::Zero();
  int held = 0;
  for (double t = 0; t < 6; t += dt) {
    const double down = 0.015 * std::clamp((t - 1) / 1.5, 0.0, 1.0) * std::clamp((5.5 - t) / 1, 0.0, 1.0);
    const Vec3 target(0.035 + 0.03 * std::clamp((t - 3) / 1.5, 0.0, 1.0), 0.05, 0.045 - down);
    bench.step_to(x);
    SafetyInput input;
    input.model = {bench.output().force, bench.output().torque};
    input.stored_j = bench.output().stored_j;
    input.tip = x;
    input.dt_s = dt;
    input.way_s = dt;
    input.engaged = true;
    const SafeForce out = safety.pass(input);
    if (t > 0.5) run.acted |= out.state;
    run.largest_step_n = std::max(run.largest_step_n, (out.wrench.force - before).norm());
    before = out.wrench.force;
    if (t > 2.7 && t < 3) run.held_n += out.wrench.force.norm(), ++held;
    for (int s = 0; s < kSubsteps; ++s) {
      const Vec3 a = (kStiffness * (target - x) - kDamping * v + out.wrench.force) / kMass;
      v += a * dt / kSubsteps;
      x += v * dt / kSubsteps;
    }
  }
  run.held_n /= held;
  run.given_j = safety.tank().given_j();
  return run;
}

TEST(HandInTheLoop, FeelsTheSameForceAtEveryRate) {
  const HandRun fast = run_hand(1000, 0), slow = run_hand(300, 0);
  EXPECT_GT(fast.held_n, 0.5);
  EXPECT_NEAR(slow.held_n, fast.held_n, 0.02 * fast.held_n);
}

TEST(HandInTheLoop, SafetyStaysOutOfAnOrdinaryPress) {
  for (const double friction : {0.0, 0.3}) {
    const HandRun run = run_hand(1000, friction);
    EXPECT_EQ(run.acted, 0u) << "friction " << friction;
    EXPECT_LE(run.given_j, node::EnergyTank::kReserve_j);
  }
}

// Sliding over the edges of the mesh: no step beyond what motion and stiffness explain. The hand moves by at
// most 0.05 mm a tick; the block is nowhere stiffer than 1 kN/m under this tool: 0.05 N.
TEST(HandInTheLoop, ForceIsContinuousOverEdges) {
  EXPECT_LE(run_hand(1000, 0).largest_step_n, 0.05);
}

TEST(ToolLine, ADeviceTooSlowForAForceIsAFaultNamedOnce) {
  for (const int interval_ms : {25, 26, 30, 50, 100}) {
    SCOPED_TRACE(interval_ms);
    LineBench bench;
    for (int i = 0; i < 20; ++i) bench.press_slowly({0.05, 0.05, 0.032}, interval_ms);
    const std::vector<runtime::Fault> faults = bench.faults().list();
    EXPECT_EQ(faults.size(), interval_ms <= 26 ? 0u : 1u);
    for (const runtime::Fault& fault : faults)
      EXPECT_NE(fault.text.find("tool 0: poses come less than 40"), std::string::npos);
  }
}

TEST(ToolLine, PausesOfAFastDeviceAreNoSlowDevice) {
  LineBench bench;
  for (int i = 0; i < 60; ++i) bench.press_slowly({0.05, 0.05, 0.045}, i % 3 == 0 ? 60 : 1);
  EXPECT_FALSE(bench.faults().any());
}

}  // namespace
}  // namespace omentum::haptic_test
