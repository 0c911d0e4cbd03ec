// A device that moves as hands do, and a client beside it that sends whatever it likes under the same name.
#pragma once

#include "tests/haptic_node/haptic_block.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace omentum::haptic_test {

/// Both count on from `seq`, with a gap. Poses of the hand begin at kAbove, at rest.
class HostilePoses {
 public:
  explicit HostilePoses(std::uint64_t seq) : seq_(seq + kOldest) {}

  /// Of the hand, that presses the block by 2 cm and comes out of it once a second: the next millisecond's.
  msg::ToolPose honest(std::int64_t now_ns) {
    constexpr double kDepth_m = 12e-3, kPress_s = 1;
    ++hand_ms_;
    return honest_ = pose(
               now_ns, kAbove - Vec3(0, 0, kDepth_m * (1 - std::cos(2 * M_PI * 1e-3 * hand_ms_ / kPress_s))));
  }

  /// Anything but a pose of that hand.
  msg::ToolPose rubbish() {
    msg::ToolPose bad = honest_;
    switch (std::uniform_int_distribution<int>(0, 7)(random_)) {
      case 0:
        *number(bad) = any({kNan, -kNan, kInfinity, -kInfinity, 1e308, -1e308});
        break;
      case 1:
        bad = pose(honest_.stamp_ns + 1, kAbove + Vec3(unit(), unit(), unit()));
        break;  // a jump
      case 2:
        bad.seq -= back();
        break;
      case 3:
        bad.position.z -= 0.01 * unit();
        break;  // the number of the newest again
      case 4:
        bad = pose(honest_.stamp_ns - back() * 1'000'000, kPressed);
        break;
      case 5:
        bad.orientation.w = 3 * unit();
        break;
      case 6:
        bad.valid = false, bad.position.x = any({kNan, 0.0});
        break;
      default:
        bad.tool = tool(), bad.position.z -= 0.01 * unit();
    }
    return bad;
  }

 private:
  static constexpr std::int64_t kOldest = 5000;  // samples, and ms, that something old is behind at most
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  msg::ToolPose pose(std::int64_t now_ns, const Vec3& tip) {
    msg::ToolPose pose{};
    pose.seq = ++seq_;
    pose.stamp_ns = now_ns;
    pose.valid = true;
    pose.position = {.x = tip.x(), .y = tip.y(), .z = tip.z()};
    pose.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
    return pose;
  }
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  // never the same twice: poses that agree among themselves are a device that began anew
  std::int64_t back() { return std::uniform_int_distribution<std::int64_t>(1, kOldest)(random_); }
  // the grasper that nobody holds, and tools that the scene does not have
  std::uint32_t tool() { return std::array{3u, 7u, 0xffffffffu}[random_() % 3]; }
  double any(std::initializer_list<double> choices) {
    return *(choices.begin() + random_() % choices.size());
  }
  double* number(msg::ToolPose& p) {
    const std::array<double*, 8> all{&p.position.x,         &p.position.y,    &p.position.z,
                                     &p.orientation.w,      &p.orientation.x, &p.linear_velocity.x,
                                     &p.angular_velocity.z, &p.grip};
    return all[random_() % all.size()];
  }

  std::mt19937 random_{17};
  std::uint64_t seq_;
  int hand_ms_ = 0;
  msg::ToolPose honest_{};
};

}  // namespace omentum::haptic_test
