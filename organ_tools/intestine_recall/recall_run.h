// Raghupathi 2004, fig. 14: what the searches find of all that collides, step by step.
#pragma once

#include "geometry/gut_anatomy.h"
#include "organ_tools/intestine_recall/colliding_regions.h"

#include <array>
#include <cstdint>

namespace omentum::intestine_recall {

inline constexpr std::array kMethods{"stochastic", "complete"};
inline constexpr int kGrace = 3;  // steps after first contact in which a search may still be looking

struct RecallOptions {
  geometry::GutAnatomy anatomy;
  double settle_s = 0;  // before: both searches follow, nothing is compared
  double seconds = 60;
  double step_s = 5e-3;
  std::uint64_t seed = 1;
};

/// Of a step.
struct RecallSample {
  std::int32_t regions = 0;                           // that collide
  std::array<std::int32_t, kMethods.size()> found{};  // of these
};

/// Of a method over a run.
struct MethodTotals {
  std::int64_t found = 0;          // regions, summed over steps
  std::int64_t found_in_time = 0;  // of RecallReport::lasting, by the end of kGrace
  std::int64_t tests = 0;          // of distances
};

struct RecallReport {
  std::vector<RecallSample> samples;  // [steps]
  std::int64_t regions = 0;           // summed over steps
  std::int64_t lasting = 0;           // regions that lasted kGrace steps after their first
  std::int64_t exhaustive_tests = 0;  // O(n^2), summed over steps
  std::array<MethodTotals, kMethods.size()> methods;
};

/// A gut falls on a plane and is pulled about by a hand (PullingHand); the complete search drives it. At the
/// beginning of each step both searches, each with its own memory, see what every pair says collides. A
/// region is found when one of its pairs is. It goes on from those of the step before that it overlaps or
/// borders on, and is as old as the oldest of these. Throws geometry::InputError for an anatomy that cannot
/// be.
RecallReport measure_recall(const RecallOptions& options);

}  // namespace omentum::intestine_recall
