// From places that jump, 30 times a second or less, to a way that a hand could go, a thousand times a second.
#pragma once

#include "device_bridge/hand_model.h"

namespace omentum::device {

/// A brisk hand in a simulator, m/s: haptic_node refuses ten times that as a jump. A pointer that is thrown
/// across the window moves the instrument no faster.
inline constexpr double kFastestGlide_m_s = 0.5;
/// m/s^2: from rest to the fastest in 40 ms.
inline constexpr double kGlideAcceleration_m_s2 = 12;
/// In which the way that is left shrinks to a third, s: over a frame of 30 Hz, so that steps of one ray after
/// the other become one motion.
inline constexpr double kGlide_s = 0.05;
// who brakes as the way shrinks, v = e / kGlide_s, needs v / kGlide_s: never more than there is, so that the
// place is never passed
static_assert(kFastestGlide_m_s / kGlide_s <= kGlideAcceleration_m_s2);

/// One step towards `wanted`: v follows min(|e| / kGlide_s, kFastestGlide_m_s) e / |e|, e = wanted - x, by
/// at most kGlideAcceleration_m_s2 dt_s. Bounded in speed and acceleration whatever is wanted.
Motion glide(const Motion& now, const Vec3& wanted, double dt_s) noexcept;

/// One step of an orientation towards `wanted`, the short way round, at no more than `fastest_rad_s`.
Quat turn_towards(const Quat& now, const Quat& wanted, double fastest_rad_s, double dt_s) noexcept;

}  // namespace omentum::device
