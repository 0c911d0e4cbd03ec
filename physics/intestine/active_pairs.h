// Raghupathi 2004, section 4.1: pairs of parts that are followed where their distance is least.
#pragma once

#include "physics/intestine/gut_distance.h"
#include "physics/intestine/pair_finder.h"
#include "physics/intestine/pair_memory.h"

namespace omentum::physics {

/// The paper's stochastic search. Active pairs are local minima of the distance; in each step each goes to
/// the nearest of itself and its neighbours: nine tests of two segments of the axis; for a segment and the
/// mesentery two steps, first along the axis, then over the sheet, with at most eight tests (the paper: 13),
/// because the place of the closest point in its triangle says which neighbours can be nearer. Two that meet
/// are merged, one that settles beyond the threshold is dropped. Each step adds new pairs at random, half of
/// them of the axis with itself; these look around in strides of 8, 4 and 2 before they settle. From each
/// active pair that collides the search spreads to all neighbours that collide. No pair is measured twice in
/// a step. What was not found yet is not known: gaps are those of what was measured.
class ActivePairs : public PairFinder {
 public:
  /// `new_pairs`: in each step; `seed`: of a generator of our own (SplitMix64), the same on every machine.
  ActivePairs(const GutParts& parts, std::int32_t new_pairs, std::uint64_t seed);

  void find(std::span<const geometry::Vec3> x, std::span<const double> way_m, double watched_m,
            NearPairs& found) noexcept override;
  double farthest_gap_m() const noexcept override { return parts_.least_reach_m(); }
  std::size_t most_pairs() const noexcept override { return most_; }
  std::size_t tracked() const noexcept override { return active_.size(); }
  std::int64_t distance_tests() const noexcept override { return tests_; }
  void reset() noexcept override;
  /// With its active pairs, which would take many steps to be found again.
  void take_up(const PairFinder& other) noexcept override;

 private:
  struct Active {
    std::int32_t segment, part, stride;
    double distance_m;
  };
  GutParts parts_;
  std::size_t most_;
  std::int32_t new_pairs_;
  std::uint64_t seed_, random_;
  std::vector<Active> active_;
  // A pair that was measured in this step.
  struct Measured {
    bool looked_at = false;  // as a member of a colliding area
    PairPlaces places;
  };
  struct Nothing {};
  using Memory = PairMemory<Measured>;
  Memory memory_;
  PairMemory<Nothing> merged_;
  std::vector<Memory::Entry*> area_;  // still to be spread from
  std::int64_t tests_ = 0;
  std::span<const geometry::Vec3> x_;  // of the newest search
  double threshold_m_ = 0;

  std::uint64_t random_below(std::uint64_t end) noexcept;
  void add_random_pair(bool of_axis) noexcept;
  Memory::Entry* test(std::int32_t segment, std::int32_t part) noexcept;
  void try_pair(std::int32_t segment, std::int32_t part, Active& best) noexcept;
  void look_along_axis(Active& pair) noexcept;
  void look_over_sheet(Active& pair) noexcept;
  bool settle(Active& pair) noexcept;
  void spread(std::int32_t segment, std::int32_t part, std::span<const double> way_m, double watched_m,
              NearPairs& found) noexcept;
  void join_area(std::int32_t segment, std::int32_t part) noexcept;
};

}  // namespace omentum::physics
