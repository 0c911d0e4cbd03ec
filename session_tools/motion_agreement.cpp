#include "session_tools/motion_agreement.h"

#include <Eigen/Geometry>

#include <cmath>

namespace omentum::session {

namespace {

constexpr double kInterval_s = 0.02;
constexpr double kLongest_s = 0.2;  // of an interval: after a gap, nobody knows the way between

Eigen::Vector3d vector(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}

Eigen::Quaterniond quaternion(const msg::Quat& q) {
  return Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

// the turn that brings `before` to `after`, in the axes in which both stand: axis times angle
Eigen::Vector3d turn(const Eigen::Quaterniond& before, const Eigen::Quaterniond& after) {
  const Eigen::AngleAxisd turned(after * before.conjugate());
  return turned.angle() * turned.axis();
}

}  // namespace

void MotionAgreement::add(const Eigen::Vector3d& told, const Eigen::Vector3d& seen) noexcept {
  told_seen_ += told.dot(seen);
  told_told_ += told.squaredNorm();
  seen_seen_ += seen.squaredNorm();
  ++count_;
}

double MotionAgreement::speed() const noexcept {
  return count_ == 0 ? 0 : std::sqrt(seen_seen_ / static_cast<double>(count_));
}

double MotionAgreement::agreement() const noexcept {
  const double scale = std::sqrt(told_told_ * seen_seen_);
  return scale > 0 ? told_seen_ / scale : 0;
}

double MotionAgreement::ratio() const noexcept {
  return seen_seen_ > 0 ? std::sqrt(told_told_ / seen_seen_) : 0;
}

void MotionWatch::take(const msg::ToolPose& pose) noexcept {
  if (!pose.valid) {
    interval_.reset();
    return;
  }
  if (interval_) {
    const double seconds = 1e-9 * static_cast<double>(pose.stamp_ns - interval_->first.stamp_ns);
    if (seconds >= kInterval_s) {
      if (seconds <= kLongest_s) finish(pose, seconds);
      interval_.reset();
    }
  }
  if (!interval_) interval_ = Interval{.first = pose};
  interval_->linear += vector(pose.linear_velocity);
  interval_->angular += vector(pose.angular_velocity);
  ++interval_->poses;
}

void MotionWatch::finish(const msg::ToolPose& last, double seconds) noexcept {
  const msg::ToolPose& first = interval_->first;
  const double poses = interval_->poses;
  linear_.add(interval_->linear / poses, (vector(last.position) - vector(first.position)) / seconds);
  angular_.add(interval_->angular / poses,
               turn(quaternion(first.orientation), quaternion(last.orientation)) / seconds);
}

}  // namespace omentum::session
