// A hand at tissue that is told of late: what it really receives, and what it feels all the same.
#include "haptic_node/tool_line.h"
#include "late_tissue.h"

namespace omentum::haptic_test {
namespace {

using haptic::ForceSafety;
using haptic::SafeForce;
using haptic::SafetyInput;

constexpr double kMs_s = 1e-3;

/// A hand of 200 g on a spring and a damper, and what is late between it and the organ.
struct LateCase {
  const char* name;
  bool pulls = false;                 // with jaws; else it presses
  double late_ms = 0, jitter_ms = 0;  // on either way
  double hand_n_m = 400;
  double swing_hz = 4, damping = 0.2;
  bool asks = true;  // the account gives back no more than the tank covers
};

struct LateRun {
  double most_j = -1, given_j = 0;  // what the hand really received: at most, and in the end
  double account_j = 0;             // the same as the tank has it
  double least_share = 1, peak_n = 0;
};

double part(double t, double from, double to) {
  return std::clamp((t - from) / (to - from), 0.0, 1.0);
}

/// Presses by 9 mm, or closes its jaws and lifts by 14 mm; holds; goes back and away.
struct Script {
  double height_m, grip_rad;
};
Script script_at(double t, bool pulls) {
  if (!pulls) return {0.003 - 0.012 * part(t, 0.3, 1) + 0.012 * part(t, 3.5, 4.3), 0};
  return {0.003 - 0.005 * part(t, 0.3, 0.7) + 0.014 * part(t, 1.1, 1.8) - 0.009 * part(t, 3.5, 4.2) +
              0.01 * part(t, 4.6, 5),
          0.5 - 0.48 * part(t, 0.7, 1) + 0.48 * part(t, 4.2, 4.5)};
}

/// What arrives in its order, each after a time of its own.
template <class T>
class LateWire {
 public:
  void send(int now_ms, double way_ms, T what) {
    due_ms_ = std::max(due_ms_, now_ms + way_ms);
    waiting_.emplace_back(due_ms_, std::move(what));
  }
  template <class Take>
  void arrive(int now_ms, Take&& take) {
    for (; !waiting_.empty() && waiting_.front().first <= now_ms; waiting_.pop_front())
      take(std::move(waiting_.front().second));
  }

 private:
  double due_ms_ = 0;
  std::deque<std::pair<double, T>> waiting_;
};

class LateHand {
 public:
  explicit LateHand(const LateCase& c)
      : case_(c), bench_(with_spare_place(make_model(block(), {tool(c.pulls)}))) {
    bench_.work().doors[0].post(haptic::make_local_body(tissue_.step()));
  }

  const LateRun& run() {
    constexpr int kEnd_ms = 5200;
    for (int ms = 0; ms < kEnd_ms; ++ms) {
      const Script script = script_at(kMs_s * ms, case_.pulls);
      move(kTop + Vec3(0, 0, script.height_m), script.grip_rad);
      exchange(ms);
      feel();
    }
    run_.account_j = safety_.tank().given_j();
    return run_;
  }

 private:
  static haptic::ToolModel tool(bool grasps) {
    haptic::ToolModel tool = round_tool();
    tool.grasps = grasps;
    return tool;
  }

  double way_ms() {
    const double off = std::uniform_real_distribution<double>(-case_.jitter_ms, case_.jitter_ms)(random_);
    return std::max(0.0, case_.late_ms + off);
  }

  void move(const Vec3& target, double grip) {
    constexpr int kParts = 20;
    constexpr double kMass_kg = 0.2, kDamping_n_s_m = 12;
    const Vec3 from = tip_;
    for (int i = 0; i < kParts; ++i) {
      const Vec3 pull = case_.hand_n_m * (target - tip_) - kDamping_n_s_m * velocity_ + felt_.force;
      velocity_ += pull / kMass_kg * kMs_s / kParts;
      tip_ += velocity_ * kMs_s / kParts;
    }
    run_.given_j += felt_.force.dot(tip_ - from) + felt_.grip_torque * (grip - grip_);
    run_.most_j = std::max(run_.most_j, run_.given_j);
    grip_ = grip;
  }

  void exchange(int ms) {
    constexpr int kStep_ms = 20, kTold_ms = 5;
    static_assert(LateTissue::kStep_s == kStep_ms * kMs_s);
    bench_.state().now_ns += 1'000'000;
    if (ms % kStep_ms == 0) {
      up_.arrive(ms, [&](LateTissue::Told told) { tissue_.hear(std::move(told)); });
      down_.send(ms, way_ms(), tissue_.step());
    }
    down_.arrive(ms, [&](haptic::LocalPatch patch) {
      patch.arrival_ns = bench_.state().now_ns;
      bench_.work().doors[0].post(haptic::make_local_body(patch));
    });
    bench_.place(0, tip_, grip_);
    if (case_.asks) bench_.input().covered_j = safety_.covered_j();
    bench_.step();
    if (ms % kTold_ms == 0) up_.send(ms, way_ms(), tissue_.told_by(bench_));
  }

  void feel() {
    const haptic::ToolOutput& output = bench_.output();
    SafetyInput input;
    input.model = {output.force, output.torque, output.grip_torque};
    input.stored_j = output.stored_j;
    input.tip = tip_;
    input.grip = grip_;
    input.dt_s = input.way_s = kMs_s;
    input.engaged = true;
    felt_ = safety_.pass(input).wrench;
    run_.peak_n = std::max(run_.peak_n, felt_.force.norm());
    run_.least_share = std::min(run_.least_share, safety_.share());
  }

  inline static const Vec3 kTop{0.05, 0.05, 0.04};

  LateCase case_;
  Bench bench_;
  LateTissue tissue_{kTop, 0.03, case_.swing_hz, case_.damping};
  ForceSafety safety_{haptic::ForceLimits{}};
  std::mt19937 random_{3};
  LateWire<LateTissue::Told> up_;
  LateWire<haptic::LocalPatch> down_;
  Vec3 tip_ = kTop + Vec3(0, 0, 0.003), velocity_ = Vec3::Zero();
  double grip_ = 0.5;
  haptic::Wrench felt_;
  LateRun run_;
};

LateRun run_late(const LateCase& c) {
  return LateHand(c).run();
}

// The loop of a hand and tissue that hear each other late swings by itself: without the account's knowledge
// of the tank it feeds the hand until the tank cuts its force.
TEST(LateTissue, FeedsAHandWhoseAccountDoesNotAskTheTank) {
  EXPECT_LT(run_late({.name = "press", .late_ms = 50, .asks = false}).least_share, 0.1);
}

TEST(LateTissue, GivesNoMoreThanIsCoveredAndIsNeverCut) {
  const double kOnTime_n[] = {run_late({.name = "press"}).peak_n,
                              run_late({.name = "pull", .pulls = true}).peak_n};
  for (const LateCase& c : {LateCase{.name = "press, late", .late_ms = 50},
                            LateCase{.name = "press, later", .late_ms = 200, .hand_n_m = 150},
                            LateCase{.name = "pull, a little late", .pulls = true, .late_ms = 10},
                            LateCase{.name = "pull, jitter", .pulls = true, .late_ms = 50, .jitter_ms = 40},
                            LateCase{.name = "pull, late", .pulls = true, .late_ms = 100}}) {
    const LateRun run = run_late(c);
    EXPECT_LE(run.most_j, node::EnergyTank::kReserve_j) << c.name;
    EXPECT_NEAR(run.account_j, run.given_j, 1e-3) << c.name << ": the tank has it as it is";
    EXPECT_EQ(run.least_share, 1) << c.name;
    if (c.hand_n_m == 400) {
      EXPECT_GE(run.peak_n, 0.9 * kOnTime_n[c.pulls ? 1 : 0]) << c.name;
    }
  }
}

// On time nothing is taken from it.
TEST(LateTissue, OnTimeIsFeltInFull) {
  for (const bool pulls : {false, true}) {
    const LateRun asks = run_late({.name = "", .pulls = pulls});
    const LateRun bare = run_late({.name = "", .pulls = pulls, .asks = false});
    EXPECT_GE(asks.peak_n, 0.99 * bare.peak_n) << pulls;
    EXPECT_GT(asks.peak_n, 1) << pulls;
  }
}

// What goes along with a hand whatever its account says is a source that somebody must know of.
TEST(LateTissue, ABodyThatFeedsTheHandIsAFault) {
  runtime::FaultList faults;
  haptic::ToolLine line(0, {}, faults);
  haptic::ToolOutput output;
  output.force = Vec3(0, 0, 3);
  msg::ToolPose pose{};
  pose.valid = true;
  pose.orientation.w = 1;
  for (int ms = 0; ms < 1000; ++ms) {
    const std::int64_t now_ns = 1'000'000 * std::int64_t{ms};
    pose.seq = static_cast<std::uint64_t>(ms) + 1;
    pose.stamp_ns = now_ns + 1;
    pose.position.z = 1e-4 * ms;
    static_cast<void>(line.hear(pose, now_ns));
    haptic::ToolInput input;
    static_cast<void>(line.listen(now_ns, input));
    EXPECT_LE(input.covered_j, node::EnergyTank::kReserve_j);
    line.answer(output, now_ns, kMs_s, false);
    line.sent(true);
  }
  const auto lines = faults.lines();
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.front().find("contact feeds the hand"), std::string::npos) << lines.front();
}

}  // namespace
}  // namespace omentum::haptic_test
