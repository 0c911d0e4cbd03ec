// Fingers on a grasper's handle that are a button: how far its jaws are open.
#pragma once

namespace omentum::device {

/// What a button asks of jaws.
enum class JawWish { kStay, kClose, kOpen };

/// How far jaws open, rad: as the simulated hands' do.
inline constexpr double kJawsOpen_rad = 0.5;
/// rad/s: shut half a second after the button goes down.
inline constexpr double kJawRate_rad_s = 1;
/// With which a button squeezes at most, N m: 5 N at the tip of jaws of 18 mm.
inline constexpr double kSqueeze_nm = 0.1;

/// The opening `dt_s` later. `torque_nm`: on the jaws, positive opens. Jaws that close go slower the harder
/// what lies between them resists, stop at kSqueeze_nm and give way above it, also when they should stay:
///
///     g' = r (t / t_s - 1) closing,  r max(0, t / t_s - 1) staying,  r opening;  |g'| <= r
///
/// A damper with a constant drive: it takes energy out of whatever oscillates.
double step_jaws(double grip_rad, JawWish wish, double torque_nm, double dt_s) noexcept;

}  // namespace omentum::device
