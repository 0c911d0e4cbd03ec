// Where a person wants an instrument, as the rays of a pointer say it one after the other.
#pragma once

#include "device_bridge/device.h"

#include <optional>

namespace omentum::device {

/// What was held down is held down no more once rays are silent for so long, s.
inline constexpr double kRaysSilent_s = 0.5;
/// Between two rays that are no farther apart the pointer's way counts, s: software OpenGL on a busy machine
/// draws one or two frames a second. After more the window was gone, and the next ray begins anew.
inline constexpr double kWindowGone_s = 2;
/// Of the tip along the ray, m per step of the wheel: from 3 cm above an organ to its surface in eight.
inline constexpr double kWheelStep_m = 0.004;
/// Likewise while a key is held down, m/s: a press of a liver in half a second.
inline constexpr double kKeyDepth_m_s = 0.03;
/// About the shaft while a key is held down, rad/s: a quarter turn in a second and a half.
inline constexpr double kKeyRoll_rad_s = 1;
/// Of the shaft, rad, for a pointer that goes as far as the viewer is away (tangent 1).
inline constexpr double kTiltPerTangent = 3;
/// How much of its way the pointer gives to bring the tip back under it, where they came apart.
inline constexpr double kCatchUp = 0.3;

/// The tip goes as the pointer goes, in the plane through the wanted place that faces the viewer, so that
/// both keep together on the screen; wheel and keys move it along the ray:
///
///     a = d.right / d.forward, b = d.up / d.forward, z = (wanted - eye).forward, forward = up x right
///     wanted += z (da right + db up) + (wheel steps, seconds of keys) d
///
/// Only motion counts, never a place: after a pause, a turn of the camera, or a tool that tissue held, the
/// tip stays where it is until the pointer moves, and comes back under it on the way (kCatchUp). A camera
/// that moves carries nothing along. Reads no clock. One thread.
class PointerAim {
 public:
  /// From here on this place is wanted; the next ray is where the pointer begins.
  void start(const Vec3& place) noexcept;
  /// The next ray is where the pointer begins; what is wanted stays.
  void let_go() noexcept { before_.reset(); }
  /// What is beyond `most`, along the unit vector `along`, is wanted no more.
  void give_up_beyond(const Vec3& most, const Vec3& along) noexcept;
  /// Instead of what is wanted, somewhere that can be reached.
  void correct(const Vec3& place) noexcept { wanted_ = place; }

  /// A new ray, which came at `now_ns`. One that is no ray (not finite, no unit vectors, from behind the
  /// viewer) is ignored; one that is not valid ends what is followed, so that the next one begins anew.
  void take(const msg::PointerRay& ray, std::int64_t now_ns) noexcept;

  const Vec3& wanted() const noexcept { return wanted_; }  // p_WT, m
  double roll() const noexcept { return roll_; }           // about the shaft since start(), rad
  /// The turn that the pointer asked for since the last call, as a vector in W, rad.
  Vec3 take_tilt() noexcept;

  /// The newest ray, while it is valid and what it says is held down is so.
  const msg::PointerRay* ray(std::int64_t now_ns) const noexcept;
  /// Whether a ray of this moment would go on from one before.
  bool goes_on(std::int64_t now_ns) const noexcept;

 private:
  void follow(const msg::PointerRay& ray, double seconds) noexcept;

  Vec3 wanted_ = Vec3::Zero();
  Vec3 tilt_ = Vec3::Zero();
  double roll_ = 0;
  std::optional<msg::PointerRay> before_;  // the newest one that was followed
  std::int64_t before_ns_ = 0;
};

/// Whether every number of it can be used: finite, unit vectors, nothing beyond all meaning.
bool is_ray(const msg::PointerRay& ray) noexcept;

}  // namespace omentum::device
