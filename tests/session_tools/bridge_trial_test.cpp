// device_check's judgement of bridges that do what they owe, and of bridges that break one rule each.
#include "session_tools/answer_trial.h"
#include "session_tools/pose_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <limits>

namespace omentum::session {
namespace {

using Outcome = Verdict::Outcome;

constexpr double kPeriod_s = 1e-3;
constexpr TrialTimes kShort{
    .listening_s = 0.5, .felt_s = 0.5, .silent_s = 0.2, .intruded_s = 0.5, .fault_s = 0.2, .force_n = 0.3};

msg::Vec3 message(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// A bridge as docs/devices.md asks for one, of a tool that goes to and fro and turns about a tilted axis.
/// What it would send, and what it takes of its answers, a test can spoil.
struct SimulatedBridge {
  std::function<void(msg::ToolPose&)> spoil = [](msg::ToolPose&) {};
  bool holds_forever = false, takes_everything = false, holds_in_a_fault = false, stops_in_silence = false;
  double period_s = kPeriod_s;

  msg::DeviceInfo info{.tool = 0,
                       .name = "simulated",
                       .max_force_n = 10,
                       .max_torque_nm = 1,
                       .max_stiffness_n_m = 1000,
                       .workspace_min = {-0.1, -0.1, -0.1},
                       .workspace_max = {0.1, 0.1, 0.1}};

  msg::ToolPose pose(double t) {
    constexpr double kAmplitude_m = 0.03, kFrequency = 6, kTurn_rad_s = 0.8;
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 2) / 3;
    const Eigen::Quaterniond q(Eigen::AngleAxisd(kTurn_rad_s * t, axis));
    msg::ToolPose pose{.tool = 0,
                       .seq = ++seq_,
                       .stamp_ns = static_cast<std::int64_t>(1e9 * t),
                       .valid = true,
                       .position = {kAmplitude_m * std::sin(kFrequency * t), 0, 0},
                       .orientation = {q.w(), q.x(), q.y(), q.z()},
                       .linear_velocity = {kAmplitude_m * kFrequency * std::cos(kFrequency * t), 0, 0},
                       .angular_velocity = message(kTurn_rad_s * axis),
                       .answer_seq = exerted(t)};
    spoil(pose);
    return pose;
  }

  void hear(const msg::ToolForce& answer, double t) {
    const double age_s = t - 1e-9 * static_cast<double>(answer.echo_stamp_ns);
    const bool ours = answer.echo_seq <= seq_ && age_s < 0.05;
    if (!ours && !takes_everything) return;
    if (answer.state == msg::FORCE_FAULT && holds_in_a_fault) return;
    taken_ = answer.seq;
    taken_s_ = t;
  }

  std::uint64_t exerted(double t) const {
    constexpr double kHeld_s = 0.04;
    return holds_forever || holds_in_a_fault || t - taken_s_ < kHeld_s ? taken_ : 0;
  }

 private:
  std::uint64_t seq_ = 0, taken_ = 0;
  double taken_s_ = 0;
};

/// What the check says after a whole trial: each requirement with its verdict.
std::vector<Verdict> tried(SimulatedBridge bridge) {
  PoseRecord record;
  AnswerTrial trial(kShort);
  record.take(bridge.info);
  constexpr std::int64_t kBegin_ns = 1'000'000'000;
  for (double t = 1; t < 10; t += bridge.period_s) {
    const auto now_ns = kBegin_ns + static_cast<std::int64_t>(1e9 * t);
    const double into_s = t - 1 - kShort.listening_s - kShort.felt_s;
    if (bridge.stops_in_silence && into_s > 0 && into_s < kShort.silent_s) continue;
    const msg::ToolPose pose = bridge.pose(t);
    if (trial.over(now_ns)) break;
    record.take(pose, now_ns);
    for (const msg::ToolForce& answer : trial.take(pose, now_ns)) bridge.hear(answer, t);
  }
  std::vector<Verdict> all = record.verdicts();
  for (Verdict& one : trial.verdicts(record.median_gap_s())) all.push_back(std::move(one));
  return all;
}

std::vector<std::string> failed(const SimulatedBridge& bridge) {
  std::vector<std::string> names;
  for (const Verdict& one : tried(bridge))
    if (one.outcome == Outcome::kFailed) names.push_back(one.requirement);
  return names;
}

using testing::ElementsAre;

TEST(BridgeTrial, ABridgeThatDoesWhatItOwesPassesEverything) {
  for (const Verdict& one : tried({}))
    EXPECT_EQ(one.outcome, Outcome::kPassed) << one.requirement << ": " << one.detail;
}

struct Fault {
  const char* name;
  const char* requirement;
  std::function<void(SimulatedBridge&)> spoil;
};

class EachFault : public testing::TestWithParam<Fault> {};

TEST_P(EachFault, IsFoundAndNamedAlone) {
  SimulatedBridge bridge;
  GetParam().spoil(bridge);
  EXPECT_THAT(failed(bridge), ElementsAre(GetParam().requirement));
}

void send(SimulatedBridge& bridge, std::function<void(msg::ToolPose&)> spoil) {
  bridge.spoil = std::move(spoil);
}

const Fault kFaults[] = {
    {"NoLimits", "device_info is told",
     [](auto& b) { b.info.max_force_n = std::numeric_limits<double>::infinity(); }},
    {"NegativeDamping", "device_info is told", [](auto& b) { b.info.damping_n_s_m = -1; }},
    {"RepeatedNumber", "seq counts up by one",
     [](auto& b) { send(b, [](msg::ToolPose& p) { p.seq -= p.seq % 50 == 0; }); }},
    {"StampsThatRunBackwards", "stamp_ns is a steady clock in ns",
     [](auto& b) {
       send(b, [](msg::ToolPose& p) {
         if (p.seq % 500 == 0) p.stamp_ns -= 900'000'000;
       });
     }},
    {"NotUnit", "valid poses are finite, quaternions unit",
     [](auto& b) { send(b, [](msg::ToolPose& p) { p.orientation.w *= 1.1; }); }},
    {"NaN", "valid poses are finite, quaternions unit",
     [](auto& b) {
       send(b, [](msg::ToolPose& p) {
         if (p.seq == 77) p.grip = std::numeric_limits<double>::quiet_NaN();
       });
     }},
    {"OutOfTheBox", "the tip is in the workspace",
     [](auto& b) { send(b, [](msg::ToolPose& p) { p.position.z = 0.2; }); }},
    {"MillimetresPerSecond", "velocity is that of the poses",
     [](auto& b) { send(b, [](msg::ToolPose& p) { p.linear_velocity.x *= 1000; }); }},
    {"MirroredTurn", "turning is that of the poses",
     [](auto& b) {
       send(b, [](msg::ToolPose& p) {
         for (double* component : {&p.orientation.x, &p.orientation.y, &p.orientation.z}) *component *= -1;
       });
     }},
    {"HoldsTheForce", "without answers it lets go, and poses go on", [](auto& b) { b.holds_forever = true; }},
    {"TakesOthersAnswers", "other devices' and late answers are refused",
     [](auto& b) { b.takes_everything = true; }},
};

INSTANTIATE_TEST_SUITE_P(All, EachFault, testing::ValuesIn(kFaults),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BridgeTrial, ABridgeThatIsTooSlowFailsByItsRate) {
  SimulatedBridge bridge;
  bridge.period_s = 0.03;
  EXPECT_THAT(failed(bridge), testing::Contains("poses come often enough"));
}

TEST(BridgeTrial, ABridgeThatStopsWithItsAnswersFails) {
  SimulatedBridge bridge;
  bridge.stops_in_silence = true;
  EXPECT_THAT(failed(bridge), ElementsAre("without answers it lets go, and poses go on"));
}

TEST(BridgeTrial, AForceThatIsHeldThroughAFaultFails) {
  SimulatedBridge bridge;
  bridge.holds_in_a_fault = true;
  EXPECT_THAT(failed(bridge), testing::Contains("a latched fault ends the force before it, and poses go on"));
}

TEST(BridgeTrial, AToolThatNobodyMovedIsNotSeen) {
  SimulatedBridge bridge;
  bridge.spoil = [](msg::ToolPose& pose) {
    pose.position = {};
    pose.orientation = {.w = 1};
    pose.linear_velocity = pose.angular_velocity = {};
  };
  int not_seen = 0;
  for (const Verdict& one : tried(bridge)) {
    EXPECT_NE(one.outcome, Outcome::kFailed) << one.requirement;
    not_seen += one.outcome == Outcome::kUnseen;
  }
  EXPECT_EQ(not_seen, 2);
}

TEST(PoseRecord, ABridgeOfWhichAnythingIsRefusedFailsWithWhatToOffer) {
  PoseRecord record;
  EXPECT_EQ(record.offered().outcome, Outcome::kPassed);
  for (int i = 0; i < 3; ++i) record.refuse("tool_pose", "LIVELINESS must be automatic");
  record.refuse("device_info", "DURABILITY must be transient local");
  EXPECT_EQ(record.offered().outcome, Outcome::kFailed);
  EXPECT_EQ(record.offered().detail,
            "tool_pose: LIVELINESS must be automatic; device_info: DURABILITY must be transient local");
}

}  // namespace
}  // namespace omentum::session
