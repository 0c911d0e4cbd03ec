// One tool along a closed path in contact, through the haptic step alone: what it got back of what it put in.
#pragma once

#include "haptic_node/haptic_step.h"
#include "tests/support/press_place.h"

#include <array>
#include <functional>

namespace omentum::test {

/// Down through the air, press, slide at constant height, release, and back through the air.
struct ClosedPath {
  PressPlace place;
  double depth_m, direction_deg;

  static constexpr std::array<const char*, 4> kLegs = {"press", "slide", "release", "return"};
  /// Of the tip, m; the last one is the first.
  std::array<geometry::Vec3, kLegs.size() + 1> corners() const;
};

/// Work by the mean of the forces at both ends of each step.
struct ClosedPathFigures {
  double net_j = 0;          // given to the hand over the whole path
  double most_put_in_j = 0;  // by the hand, at any time
  double largest_step_n = 0, largest_force_n = 0;
  std::size_t leg = 0;  // of the largest step ...
  double along_m = 0;   // ... and where in it
  int unsolved = 0;     // ticks

  double net_share() const { return most_put_in_j > 0 ? net_j / most_put_in_j : 0; }
};

/// What a path looks like at one of its steps.
struct PathPoint {
  double way_m, depth_m;  // since its begin; below the rest surface, along the normal
  geometry::Vec3 tip;
  const haptic::ToolOutput& output;
  double given_j;
};

/// From rest, tool 0 of a model with one tool upright on the place, in steps of `step_m` at most. `watch`
/// (may be empty) sees every step.
ClosedPathFigures walk(const haptic::HapticModel& model, const ClosedPath& path, double step_m,
                       const std::function<void(const PathPoint&)>& watch = {});

}  // namespace omentum::test
