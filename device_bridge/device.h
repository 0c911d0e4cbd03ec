// What a maker of a haptic device implements: everything else in this folder can stay as it is.
#pragma once

#include "transport/messages.h"

#include <nlohmann/json.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>

namespace omentum::device {

using Vec3 = Eigen::Vector3d;
using Quat = Eigen::Quaterniond;

/// What the motors must exert on the hand: at the tip, expressed in W. Zero when there is nothing to feel.
struct Wrench {
  Vec3 force = Vec3::Zero();   // N
  Vec3 torque = Vec3::Zero();  // about the tip, N m
  double grip_torque = 0;      // on the jaws, N m, positive opens
};

/// A measurement older than this is none, s: two periods of a 100 Hz tracker, the slowest that a hand is
/// still followed with; the hand is up to 2 cm further by then. It must end somewhere: a vendor's callback
/// that died leaves its last measurement behind for ever.
inline constexpr double kOldestMeasurement_s = 0.02;

/// Where the hand holds the instrument.
struct Measurement {
  bool valid = false;            // false: the device has no measurement now; the rest is ignored
  std::int64_t measured_ns = 0;  // when it was taken, on runtime::steady_now_ns(), not when it was read
  Vec3 position = Vec3::Zero();  // p_WT, of the tip, m
  Quat orientation = Quat::Identity();   // q_WT: T's z points along the shaft from the tip to the handle
  Vec3 linear_velocity = Vec3::Zero();   // of the tip in W, m/s
  Vec3 angular_velocity = Vec3::Zero();  // in W, rad/s
  double grip = 0;                       // jaw opening angle, rad; 0 is closed
  std::uint32_t buttons = 0;             // bit i: button i is pressed
};

/// One instrument. All calls come from the bridge's loop, once a period each: command, then measure.
/// Neither may block or throw.
class Device {
 public:
  virtual ~Device() = default;

  /// The scene's tool that it moves, and its limits. Never asked for more than these.
  virtual msg::DeviceInfo info() const = 0;
  /// The wrench to exert until the next call. Already finite, decayed when the answers stopped, and within
  /// limits.
  virtual void command(const Wrench& wrench) noexcept = 0;
  /// The newest measurement. `now_ns` is the time on runtime::steady_now_ns(): what is measured in this call
  /// was measured then.
  virtual Measurement measure(std::int64_t now_ns) noexcept = 0;

  /// Whether measure() itself lets the coming period pass, under the wrench commanded just before: a
  /// simulation. Hardware came to where it is measured under the wrench before that one.
  virtual bool simulates() const noexcept { return false; }

  /// For devices that move on their own: the session pauses, continues, or starts again.
  virtual void pause(bool /*paused*/) noexcept {}
  virtual void restart() noexcept {}
  /// What the device wants to say in the report at the end, an object.
  virtual nlohmann::json report() const { return nlohmann::json::object(); }
};

inline Vec3 from_message(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}
inline msg::Vec3 to_message(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace omentum::device
