// Finds every pair that is near: lists with a margin, renewed before anything can have crossed the margin.
#pragma once

#include "physics/intestine/ball_tree.h"
#include "physics/intestine/pair_finder.h"

namespace omentum::physics {

/// Never misses a pair. Pairs nearer than reach and a margin are listed (Verlet 1967); the list holds until a
/// part has used up half of the margin. A listed pair is measured again only when the ways of both parts
/// since its last measurement could have brought it near; and one that is near, but whose neighbours answer
/// for the place (gut_parts.h), only when that may have changed: in fine guts that is most of them.
class CompletePairs : public PairFinder {
 public:
  explicit CompletePairs(const GutParts& parts);

  void find(std::span<const geometry::Vec3> x, std::span<const double> way_m, double watched_m,
            NearPairs& found) noexcept override;
  double farthest_gap_m() const noexcept override { return parts_.least_reach_m(); }
  std::size_t most_pairs() const noexcept override { return listed_.capacity(); }
  std::size_t tracked() const noexcept override { return listed_.size(); }
  std::int64_t distance_tests() const noexcept override { return tests_; }
  void reset() noexcept override;

 private:
  struct Listed {
    std::int32_t segment = 0, part = 0;
    double distance_then = 0;  // its last distance, plus the ways of both parts until then, m
  };
  GutParts parts_;
  std::vector<geometry::Vec3> last_;  // [masses], m: at the last search
  std::vector<double> moved_;         // [masses], m: since then
  std::vector<double> travelled_;     // [parts], m: sum of the ways of the fastest mass of each step
  std::vector<double> ahead_;         // [parts], m: travelled_ at the end of this step, at most
  std::vector<double> list_until_;    // [parts], m: how far it may travel with this list
  std::vector<double> around_;        // [parts], m: how near others have to come to be listed
  BallTree tree_;
  std::vector<Listed> listed_;
  // Of a listed pair that is near and does not report: what it was measured to be stands until both parts
  // have travelled so far together.
  struct Quiet {
    double until = -1;
    PairPlaces places;
  };
  std::vector<Quiet> quiet_;  // of listed_
  std::int64_t tests_ = 0;

  void travel(std::span<const geometry::Vec3> x, std::span<const double> way_m) noexcept;
  bool list_holds() const noexcept;
  void list_pairs(std::span<const geometry::Vec3> x, double watched_m) noexcept;
  // Whether it may come near before the list is made again.
  bool examine(Listed& pair, Quiet& quiet, std::span<const geometry::Vec3> x, double watched_m,
               NearPairs& found) noexcept;
};

}  // namespace omentum::physics
