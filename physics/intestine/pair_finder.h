// Finds what of an intestine is near what else of it.
#pragma once

#include "physics/intestine/gut_parts.h"

#include <vector>

namespace omentum::physics {

/// One found pair.
struct NearPair {
  std::int32_t segment = 0, part = 0;  // GutParts
  PairPlaces places;
  bool reports = false;  // its closest points, or another pair does (gut_parts.h)
};

/// A contact's name, which is the same in the next step: a segment and a part; a sphere, from -1 down, and a
/// part; a wall, behind the spheres, and a mass.
struct ContactKey {
  std::int32_t one = 0, other = 0;
};

/// What a search gives. Vectors keep the capacity that the finder asked for.
struct NearPairs {
  std::vector<NearPair> pairs;
  std::vector<double> gap;  // [masses], m: to the nearest part that it may hit; at most what was looked at
};

/// Lowers the gaps of a part's masses.
inline void lower_gap(const std::array<geometry::MassId, 3>& masses, double distance_m,
                      std::span<double> gap) {
  for (const geometry::MassId m : masses) {
    if (m.valid()) gap[m] = std::min(gap[m], distance_m);
  }
}

/// The largest of what a part's masses have.
inline double largest_of(const std::array<geometry::MassId, 3>& masses, std::span<const double> of_masses) {
  const double two = std::max(of_masses[masses[0]], of_masses[masses[1]]);
  return masses[2].valid() ? std::max(two, of_masses[masses[2]]) : two;
}

/// Searches once in a step. No search allocates.
class PairFinder {
 public:
  virtual ~PairFinder() = default;

  /// Pairs that may come within `watched_m` of their reach in this step, in an order that is the same in
  /// every run. `x`: [masses], in W, m, at its start; `way_m`: [masses], how far each goes in it at most.
  /// `found.gap` says how far each mass is from what the finder knows of, at most farthest_gap_m().
  virtual void find(std::span<const geometry::Vec3> x, std::span<const double> way_m, double watched_m,
                    NearPairs& found) noexcept = 0;
  virtual double farthest_gap_m() const noexcept = 0;
  virtual std::size_t most_pairs() const noexcept = 0;

  /// Pairs that are followed now, and distances computed in the newest search.
  virtual std::size_t tracked() const noexcept = 0;
  virtual std::int64_t distance_tests() const noexcept = 0;
  virtual void reset() noexcept = 0;
  /// Goes on where `other` is, which searches the same parts in the same way; what a search does not need to
  /// find the same may be forgotten.
  virtual void take_up(const PairFinder& /*other*/) noexcept { reset(); }
};

}  // namespace omentum::physics
