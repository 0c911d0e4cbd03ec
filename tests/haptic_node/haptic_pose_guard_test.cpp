#include "haptic_node/pose_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace omentum::haptic {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

msg::ToolPose pose(std::uint64_t seq, double x = 0, double y = 0, double z = 0) {
  msg::ToolPose p{};
  p.seq = seq;
  p.stamp_ns = static_cast<std::int64_t>(seq) * kMs;
  p.valid = true;
  p.position = {.x = x, .y = y, .z = z};
  p.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
  return p;
}

TEST(PoseGuard, TheFirstPoseIsANewConnection) {
  PoseGuard guard;
  EXPECT_EQ(guard.judge(pose(17), 0), PoseVerdict::kReconnected);
  EXPECT_EQ(guard.judge(pose(18, 0.001), kMs), PoseVerdict::kAccepted);
}

TEST(PoseGuard, CountsLostSamples) {
  PoseGuard guard;
  guard.judge(pose(1), 0);
  guard.judge(pose(2), kMs);
  guard.judge(pose(6), 5 * kMs);
  EXPECT_EQ(guard.lost(), 3u);
}

TEST(PoseGuard, RefusesRepeatedAndOlderSamples) {
  PoseGuard guard;
  guard.judge(pose(10), 0);
  EXPECT_EQ(guard.judge(pose(10), kMs), PoseVerdict::kOldSequence);
  EXPECT_EQ(guard.judge(pose(9), kMs), PoseVerdict::kOldSequence);
  msg::ToolPose late = pose(11);
  late.stamp_ns = pose(10).stamp_ns - 1;
  EXPECT_EQ(guard.judge(late, kMs), PoseVerdict::kOldSequence);
}

TEST(PoseGuard, AnOldMeasurementUnderANewNumberIsRefused) {
  PoseGuard guard;
  guard.judge(pose(10), 0);
  msg::ToolPose again = pose(11);
  again.stamp_ns = pose(10).stamp_ns;
  EXPECT_EQ(guard.judge(again, kMs), PoseVerdict::kSameMeasurement);
  EXPECT_FALSE(is_fault(PoseVerdict::kSameMeasurement)) << "a device that is faster than its tracker is none";
  EXPECT_EQ(guard.judge(pose(again.seq + 1), 2 * kMs), PoseVerdict::kAccepted);
  EXPECT_EQ(guard.lost(), 0u) << "it came, it was only nothing new";
}

TEST(PoseGuard, StampsFromTheEndsOfTheirRangeAreNoSmallGap) {
  constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min(),
                         kHighest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(stamp_difference_ns(kLowest, kHighest), kHighest);
  EXPECT_EQ(stamp_difference_ns(kHighest, kLowest), kLowest);
  EXPECT_EQ(stamp_difference_ns(3, 5), 2);
  PoseGuard guard;
  msg::ToolPose first = pose(1), second = pose(2, 0.05);
  first.stamp_ns = kLowest;
  second.stamp_ns = kHighest;
  guard.judge(first, 0);
  EXPECT_EQ(guard.judge(second, kMs), PoseVerdict::kAccepted) << "a long gap by its stamps";
}

TEST(PoseGuard, RefusesWhatIsNotANumberInEveryField) {
  for (const double bad : {kNan, kInf, -kInf}) {
    for (int field = 0; field < 14; ++field) {
      PoseGuard guard;
      guard.judge(pose(1), 0);
      msg::ToolPose p = pose(2);
      double* const fields[] = {&p.position.x,         &p.position.y,
                                &p.position.z,         &p.orientation.w,
                                &p.orientation.x,      &p.orientation.y,
                                &p.orientation.z,      &p.linear_velocity.x,
                                &p.linear_velocity.y,  &p.linear_velocity.z,
                                &p.angular_velocity.x, &p.angular_velocity.y,
                                &p.angular_velocity.z, &p.grip};
      *fields[field] = bad;
      EXPECT_EQ(guard.judge(p, kMs), PoseVerdict::kNotFinite) << "field " << field;
    }
  }
}

TEST(PoseGuard, RefusesInvalidSamplesAndWrongQuaternions) {
  PoseGuard guard;
  msg::ToolPose p = pose(1);
  p.valid = false;
  EXPECT_EQ(guard.judge(p, 0), PoseVerdict::kInvalid);
  for (const double w : {0.0, 0.5, 2.0, 1e200}) {
    p = pose(1);
    p.orientation.w = w;
    EXPECT_EQ(guard.judge(p, 0), PoseVerdict::kNotARotation) << w;
  }
}

TEST(PoseGuard, RefusesJumpsOfPlaceAndOrientation) {
  PoseGuard guard;
  guard.judge(pose(1), 0);
  EXPECT_EQ(guard.judge(pose(2, 0.05), kMs), PoseVerdict::kJump);
  msg::ToolPose turned = pose(3);
  turned.orientation = {.w = std::sqrt(0.5), .x = std::sqrt(0.5), .y = 0, .z = 0};
  EXPECT_EQ(guard.judge(turned, 2 * kMs), PoseVerdict::kJump);
  EXPECT_EQ(guard.judge(pose(4, 0.004), 3 * kMs), PoseVerdict::kAccepted);
}

TEST(PoseGuard, GrantsMotionDuringAGapButNotMoreThanInTheLongest) {
  PoseGuard guard;
  guard.judge(pose(1), 0);
  EXPECT_EQ(guard.judge(pose(11, 0.04), 10 * kMs), PoseVerdict::kAccepted);
  EXPECT_EQ(guard.judge(pose(5000, 0.5), 5000 * kMs), PoseVerdict::kJump);
}

TEST(PoseGuard, APlaceThatLastsIsANewConnection) {
  PoseGuard guard;
  guard.judge(pose(1), 0);
  const std::int64_t begin = 2 * kMs;
  for (std::uint64_t seq = 2;; ++seq) {
    const std::int64_t now = static_cast<std::int64_t>(seq) * kMs;
    const PoseVerdict verdict = guard.judge(pose(seq, 1.0), now);
    if (now - begin < PoseGuard::kReconnect_ns) {
      ASSERT_EQ(verdict, PoseVerdict::kJump) << "sample " << seq;
    } else {
      ASSERT_EQ(verdict, PoseVerdict::kReconnected);
      break;
    }
  }
}

TEST(PoseGuard, ADeviceThatStartsAgainIsANewConnection) {
  PoseGuard guard;
  guard.judge(pose(100'000), 0);
  int refused = 0;
  for (std::uint64_t seq = 0; seq < 200; ++seq) {
    const PoseVerdict verdict = guard.judge(pose(seq), static_cast<std::int64_t>(seq + 500) * kMs);
    if (verdict == PoseVerdict::kReconnected) break;
    ASSERT_EQ(verdict, PoseVerdict::kOldSequence);
    ++refused;
  }
  EXPECT_EQ(refused, PoseGuard::kReconnect_ns / kMs);
}

TEST(PoseGuard, PlacesThatChangeWildlyNeverBecomeAConnection) {
  PoseGuard guard;
  guard.judge(pose(1), 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(1, 100);
  for (std::uint64_t seq = 2; seq < 2000; ++seq) {
    EXPECT_EQ(guard.judge(pose(seq, anywhere(random)), static_cast<std::int64_t>(seq) * kMs),
              PoseVerdict::kJump);
  }
}

TEST(PoseGuard, AForgottenPastRefusesNothing) {
  PoseGuard guard;
  guard.judge(pose(100), 0);
  guard.forget();
  EXPECT_EQ(guard.judge(pose(3, 5.0), kMs), PoseVerdict::kReconnected);
}

}  // namespace
}  // namespace omentum::haptic
