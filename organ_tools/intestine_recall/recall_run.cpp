#include "organ_tools/intestine_recall/recall_run.h"

#include "organ_tools/intestine_recall/pulling_hand.h"
#include "physics/intestine/active_pairs.h"
#include "physics/intestine/complete_pairs.h"
#include "physics/intestine/gut_system.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace omentum::intestine_recall {
namespace {

using geometry::Vec3;

constexpr double kFloor_m = -0.02;  // of the plane, below the gut's lowest place at the start

// What is known of a region that lives on from step to step.
struct History {
  int age = 0;  // steps since its first
  std::array<bool, kMethods.size()> seen{};
};

physics::GutObstacle plane_below(const geometry::GutShape& gut) {
  double lowest = gut.positions.front().z();
  for (const Vec3& p : gut.positions) lowest = std::min(lowest, p.z());
  physics::GutObstacle plane;
  plane.centre.z() = lowest - gut.tube_radius_m + kFloor_m;
  return plane;
}

// A search beside the one that drives the gut.
class Watcher {
 public:
  Watcher(const physics::GutParts& parts, std::unique_ptr<physics::PairFinder> finder)
      : parts_(parts), finder_(std::move(finder)) {
    near_.pairs.reserve(finder_->most_pairs());
    near_.gap.resize(static_cast<std::size_t>(parts.gut.mass_count()));
  }

  std::set<IndexPair> find(std::span<const Vec3> x, std::span<const double> way_m) {
    finder_->find(x, way_m, physics::GutCollisions::kWatched * parts_.least_reach_m(), near_);
    std::set<IndexPair> found;
    for (const physics::NearPair& pair : near_.pairs) {
      found.insert(parts_.is_segment(pair.part)
                       ? axis_pair(pair.segment, pair.part)
                       : cell_pair(parts_.layout, pair.segment, pair.part - parts_.layout.segment_count()));
    }
    return found;
  }
  std::int64_t tests() const { return finder_->distance_tests(); }

 private:
  const physics::GutParts& parts_;
  std::unique_ptr<physics::PairFinder> finder_;
  physics::NearPairs near_;
};

class RecallRun {
 public:
  explicit RecallRun(const RecallOptions& options)
      : options_(options),
        gut_(geometry::make_gut(options.anatomy)),
        parts_(gut_),
        floor_(plane_below(gut_)),
        hand_(gut_, options.seed),
        system_(gut_, {}, {}, {.step_s = options.step_s}),
        watchers_{Watcher(parts_, std::make_unique<physics::ActivePairs>(
                                      parts_, physics::GutCollisionSettings{}.random_pairs, options.seed)),
                  Watcher(parts_, std::make_unique<physics::CompletePairs>(parts_))},
        way_m_(gut_.positions.size()) {}

  RecallReport run() {
    const auto steps_in = [&](double s) {
      return static_cast<std::int64_t>(std::llround(s / options_.step_s));
    };
    const std::int64_t all = geometry::exhaustive_tests(parts_.layout, parts_.near),
                       steps = steps_in(options_.seconds);
    for (std::int64_t k = 0; k < steps_in(options_.settle_s); ++k) find(go_on());
    for (std::int64_t k = 0; k < steps; ++k) step();
    report_.exhaustive_tests = steps * all;
    return std::move(report_);
  }

 private:
  using Found = std::array<std::set<IndexPair>, kMethods.size()>;

  void step() {
    const std::vector<Vec3> before = go_on();
    const Found found = find(before);
    for (std::size_t method = 0; method < kMethods.size(); ++method)
      report_.methods[method].tests += watchers_[method].tests();
    compare(regions_of(parts_.layout, all_collisions(before)), found);
  }

  // Returns where the masses were before.
  std::vector<Vec3> go_on() {
    std::vector<Vec3> before = system_.state().x;
    const auto forces = hand_.pull(before, options_.step_s);
    system_.step({.forces_n = forces, .obstacles = std::span(&floor_, 1), .spheres = {}});
    for (std::size_t m = 0; m < before.size(); ++m) way_m_[m] = (system_.state().x[m] - before[m]).norm();
    return before;
  }

  Found find(std::span<const Vec3> before) {
    Found found;
    for (std::size_t method = 0; method < kMethods.size(); ++method)
      found[method] = watchers_[method].find(before, way_m_);
    return found;
  }

  // Of the parts that both searches know, by every pair.
  geometry::GutOverlaps all_collisions(std::span<const Vec3> x) {
    corners_.clear();
    for (std::int32_t m = 0; m < parts_.layout.mass_count(); ++m)
      corners_.push_back(x[static_cast<std::size_t>(parts_.own_mass(geometry::MassId(m)))]);
    return geometry::all_overlaps(parts_.layout, corners_, parts_.reach, parts_.near);
  }

  void compare(const std::vector<Region>& regions, const Found& found) {
    RecallSample sample{static_cast<std::int32_t>(regions.size()), {}};
    std::map<IndexPair, History> now;
    for (const Region& region : regions) {
      History history = history_of(region);
      for (std::size_t method = 0; method < kMethods.size(); ++method) {
        const bool is_found =
            std::ranges::any_of(region, [&](const IndexPair& pair) { return found[method].contains(pair); });
        sample.found[method] += is_found;
        history.seen[method] = history.seen[method] || is_found;
      }
      if (history.age == kGrace) count_in_time(history);
      for (const IndexPair& pair : region) now[pair] = history;
    }
    histories_ = std::move(now);
    report_.samples.push_back(sample);
    report_.regions += sample.regions;
    for (std::size_t method = 0; method < kMethods.size(); ++method)
      report_.methods[method].found += sample.found[method];
  }

  History history_of(const Region& region) const {
    History oldest{-1, {}};
    for (const IndexPair& pair : region) {
      for (const IndexPair& near : around(pair)) {
        const auto known = histories_.find(near);
        if (known != histories_.end() && known->second.age > oldest.age) oldest = known->second;
      }
    }
    ++oldest.age;
    return oldest;
  }

  void count_in_time(const History& history) {
    ++report_.lasting;
    for (std::size_t method = 0; method < kMethods.size(); ++method)
      report_.methods[method].found_in_time += history.seen[method];
  }

  RecallOptions options_;
  geometry::GutShape gut_;
  physics::GutParts parts_;
  physics::GutObstacle floor_;
  PullingHand hand_;
  physics::GutSystem system_;
  std::array<Watcher, kMethods.size()> watchers_;
  std::vector<double> way_m_;               // [masses]
  std::vector<Vec3> corners_;               // [masses of the parts]
  std::map<IndexPair, History> histories_;  // of the step before
  RecallReport report_;
};

}  // namespace

RecallReport measure_recall(const RecallOptions& options) {
  return RecallRun(options).run();
}

}  // namespace omentum::intestine_recall
