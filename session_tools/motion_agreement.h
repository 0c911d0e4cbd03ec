// Whether the velocities that a device tells are those with which it moves.
#pragma once

#include "transport/messages.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace omentum::session {

/// Of two accounts of one motion, told and seen: how far they go the same way, and how fast each of them is.
class MotionAgreement {
 public:
  /// `told` and `seen`: the mean velocity of an interval, in W. Intervals count alike.
  void add(const Eigen::Vector3d& told, const Eigen::Vector3d& seen) noexcept;

  /// Root mean square of what was seen: 0 before anything was.
  double speed() const noexcept;
  /// Correlation in -1 .. 1: 1 where every told velocity has its direction, -1 where each is reversed. 0
  /// where either never moved.
  double agreement() const noexcept;
  /// Told through seen, as root mean squares.
  double ratio() const noexcept;

 private:
  double told_seen_ = 0, told_told_ = 0, seen_seen_ = 0;
  std::uint64_t count_ = 0;
};

/// Cuts a tool's poses into intervals long beside what an encoder resolves, and compares what is told in each
/// of them with the way from its first pose to its last. Invalid poses end an interval.
class MotionWatch {
 public:
  void take(const msg::ToolPose& pose) noexcept;

  const MotionAgreement& linear() const noexcept { return linear_; }    // m/s
  const MotionAgreement& angular() const noexcept { return angular_; }  // rad/s

 private:
  struct Interval {
    msg::ToolPose first;
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(),
                    angular = Eigen::Vector3d::Zero();  // sums of what is told
    int poses = 0;
  };

  void finish(const msg::ToolPose& last, double seconds) noexcept;

  std::optional<Interval> interval_;
  MotionAgreement linear_, angular_;
};

}  // namespace omentum::session
