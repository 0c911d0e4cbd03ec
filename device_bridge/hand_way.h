// A simulated hand that goes from place to place, and opens and closes its jaws there.
#pragma once

#include "device_bridge/hand_script.h"

namespace omentum::device {

/// Duration of one round, s: all waypoints, from the last one back to the first.
double way_period_s(const scene::HandSpec& hand);

/// `t_s` >= 0; it begins at the first waypoint. Place and jaws move by minimum-jerk moves: they stand still
/// at each waypoint for a moment. What lies between two waypoints at one place is a hold. Precondition: the
/// hand has waypoints.
ScriptPoint way_at(const scene::HandSpec& hand, double t_s) noexcept;

}  // namespace omentum::device
