// What the simulated person wants: where the hand's target is at a time.
#pragma once

#include "device_bridge/hand_model.h"
#include "scene/scene.h"

namespace omentum::device {

enum class Phase { kStart, kApproach, kPress, kHold, kSlide, kRelease };

/// The target at one time: over the press point along its normal, and along the slide direction; or on its
/// way from waypoint to waypoint (hand_way.h).
struct ScriptPoint {
  Phase phase = Phase::kStart;
  double phase_share = 0;                    // [0, 1) of the phase that has passed
  double height_m = 0, height_rate_m_s = 0;  // above the rest surface; below zero while pressing
  double slide_m = 0, slide_rate_m_s = 0;
  Motion on_way{};      // of a hand with waypoints instead of both
  double grip_rad = 0;  // how far the jaws are open
  double roll_rad = 0;  // about the shaft, from where the hand holds it by itself
};

/// Duration of one round, s; then it begins again.
double script_period_s(const scene::HandSpec& hand);

/// `t_s` >= 0. Every move is a minimum-jerk one (Flash and Hogan 1985: 10 s^3 - 15 s^4 + 6 s^5), so that
/// position and velocity are continuous, from one round to the next as well. The way back along the slide
/// direction is in the second half of the release, when the instrument has left the organ.
ScriptPoint script_at(const scene::HandSpec& hand, double t_s) noexcept;

/// The same in W.
Motion target_of(const scene::HandSpec& hand, const ScriptPoint& point) noexcept;

/// Minimum-jerk share of a move at share `s` of its time (clamped to [0, 1]), and its derivative by s.
double minimum_jerk(double s) noexcept;
double minimum_jerk_rate(double s) noexcept;

}  // namespace omentum::device
