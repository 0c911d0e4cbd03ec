// Finds every pair that is near: lists with a margin, renewed before anything can have crossed the margin.
#pragma once

#include "physics/intestine/ball_tree.h"
#include "physics/intestine/pair_batch.h"
#include "physics/intestine/pair_finder.h"

namespace omentum::physics {

/// Never misses a pair. Pairs nearer than reach and a margin are listed (Verlet 1967); the list holds until a
/// part has used up its margin. A listed pair is measured again only when the ways of both parts since its
/// last measurement could have brought it near; and one that is near, but whose neighbours answer for the
/// place (gut_parts.h), only when that may have changed: in fine guts that is most of them. Those that are to
/// be measured are so together (pair_batch.h).
class CompletePairs : public PairFinder {
 public:
  explicit CompletePairs(const GutParts& parts);

  void find(std::span<const geometry::Vec3> x, std::span<const double> way_m, double watched_m,
            NearPairs& found) noexcept override;
  double farthest_gap_m() const noexcept override { return parts_.least_reach_m(); }
  std::size_t most_pairs() const noexcept override { return segments_.capacity(); }
  std::size_t tracked() const noexcept override { return segments_.size() - given_up_; }
  std::int64_t distance_tests() const noexcept override { return tests_; }
  void reset() noexcept override;
  /// With its list, which is made again no sooner than the other one's.
  void take_up(const PairFinder& other) noexcept override;

 private:
  GutParts parts_;
  std::vector<geometry::Vec3> last_;  // [masses], m: at the last search
  std::vector<double> moved_;         // [masses], m: since then
  std::vector<double> travelled_;     // [parts], m: sum of the ways of the fastest mass of each step
  std::vector<double> ahead_;         // [parts], m: travelled_ at the end of this step, at most
  std::vector<double> list_until_;    // [parts], m: how far it may travel with this list
  std::vector<double> around_;        // [parts], m: how near others have to come to be listed
  BallTree tree_;
  // Of the listed pairs: a segment and a part; how far both may have travelled together before they can be
  // near, m, infinite for what cannot be before the list is made again.
  std::vector<std::int32_t> segments_, others_;
  std::vector<double> slack_;
  // What a pair that is near and does not report was measured to be stands until both parts have travelled
  // so far together, m; -1: it does not stand.
  std::vector<double> quiet_until_;
  std::vector<PairPlaces> quiet_;
  std::size_t given_up_ = 0;         // pairs whose slack is infinite
  std::vector<std::int32_t> awake_;  // [PairBatch::kMost] of listed pairs; quiet ones as ~pair
  PairBatch batch_;
  std::int64_t tests_ = 0;

  void travel(std::span<const geometry::Vec3> x, std::span<const double> way_m) noexcept;
  bool list_holds() const noexcept;
  void list_pairs(std::span<const geometry::Vec3> x, double watched_m) noexcept;
  void examine(std::size_t first, std::size_t count, std::span<const geometry::Vec3> x, double watched_m,
               NearPairs& found) noexcept;
  void ask(std::int32_t& awake, std::size_t first, double watched_m) noexcept;
  double near_m(std::size_t pair, double watched_m) const noexcept {
    return parts_.reach_m(others_[pair]) + watched_m;
  }
  void judge(std::size_t pair, const PairPlaces& places, std::span<const geometry::Vec3> x, double near_m,
             NearPairs& found) noexcept;
  void take(std::size_t pair, const PairPlaces& places, bool reports, NearPairs& found) const noexcept;
  // Of both parts of a pair, m.
  double sum(std::span<const double> of_parts, std::size_t pair) const noexcept {
    return of_parts[static_cast<std::size_t>(segments_[pair])] +
           of_parts[static_cast<std::size_t>(others_[pair])];
  }
};

}  // namespace omentum::physics
