// Long runs of an intestine in which every step is checked for what passed through what.
#pragma once

#include "geometry/gut_shape.h"

#include <cstdint>

namespace omentum::intestine_soak {

/// What a run saw.
struct SoakReport {
  std::int64_t steps = 0;
  std::int64_t pairs = 0;  // looked at, summed over steps
  std::int64_t crossings =
      0;  // of the gut with itself and its mesentery, and of the probe's centre with both
  std::int64_t bound_acted = 0;
  std::int64_t left_out = 0;                     // contacts that found no room
  std::int64_t early_pairs = 0, most_pairs = 0;  // tracked at most early, in the first half; in all
  double deepest_m = 0;                          // overlap left by a step
  double most_j = 0;                             // kinetic and elastic energy
  bool diverged = false;

  /// Nothing passed, nothing diverged, and no list grew by more than a half after it was early.
  bool holds() const;
};

struct LongRun {
  double seconds = 600;  // of the gut's time
  double step_s = 2.5e-3;
  std::uint64_t seed = 1;  // of the hand
};

/// A gut falls on a plane and is pulled about by a hand (PullingHand) while a probe, driven with 20 N at
/// most, stirs it.
SoakReport run_long(const geometry::GutShape& gut, const LongRun& run);

/// Every free mass at 6 m/s and more, in a new direction each step of 5 ms, 3 cm where tubes are 4 cm apart,
/// until `pair_steps` pairs have been looked at: the collisions' bound alone keeps them apart.
SoakReport run_violently(const geometry::GutShape& gut, double pair_steps, std::uint64_t seed);

}  // namespace omentum::intestine_soak
