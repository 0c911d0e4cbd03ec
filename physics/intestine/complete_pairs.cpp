#include "physics/intestine/complete_pairs.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// Of the least reach: how much farther than needed pairs are listed. Less makes lists more often, more makes
// them longer.
constexpr double kMargin = 0.6;

}  // namespace

CompletePairs::CompletePairs(const GutParts& parts) : parts_(parts), tree_(parts.count()) {
  const auto count = static_cast<std::size_t>(parts.count());
  last_.reserve(static_cast<std::size_t>(parts.gut.mass_count()));
  moved_.resize(static_cast<std::size_t>(parts.gut.mass_count()));
  for (auto* of_parts : {&travelled_, &ahead_, &list_until_, &around_}) of_parts->resize(count);
  quiet_.reserve(static_cast<std::size_t>(parts.layout.segment_count()) * count);
  listed_.reserve(static_cast<std::size_t>(parts.layout.segment_count()) * count);
}

void CompletePairs::reset() noexcept {
  last_.clear();
  listed_.clear();
  for (auto* of_parts : {&travelled_, &ahead_, &list_until_}) std::ranges::fill(*of_parts, 0);
}

void CompletePairs::travel(std::span<const Vec3> x, std::span<const double> way_m) noexcept {
  if (last_.empty()) last_.assign(x.begin(), x.end());
  for (std::size_t m = 0; m < last_.size(); ++m) moved_[m] = (x[m] - last_[m]).norm();
  std::ranges::copy(x, last_.begin());
  for (std::int32_t part = 0; part < parts_.count(); ++part) {
    const std::array<MassId, 3> masses = parts_.masses[part];
    const auto p = static_cast<std::size_t>(part);
    travelled_[p] += largest_of(masses, moved_);
    ahead_[p] = travelled_[p] + largest_of(masses, way_m);
  }
}

bool CompletePairs::list_holds() const noexcept {
  return std::ranges::equal(ahead_, list_until_, std::less_equal{});
}

// The ways of this step come on top of the margin, so that a fast mass does not use up the others' list.
void CompletePairs::list_pairs(std::span<const Vec3> x, double watched_m) noexcept {
  for (std::size_t p = 0; p < around_.size(); ++p) {
    list_until_[p] = ahead_[p] + kMargin / 2 * parts_.least_reach_m();
    around_[p] = list_until_[p] - travelled_[p] + parts_.reach_m(static_cast<std::int32_t>(p)) + watched_m;
  }
  tree_.place(parts_, x, around_);
  listed_.clear();
  quiet_.clear();
  for (std::int32_t segment = 0; segment < parts_.layout.segment_count(); ++segment) {
    const auto s = static_cast<std::size_t>(segment);
    const std::array<MassId, 3>& m = parts_.masses[s];
    const double own = list_until_[s] - travelled_[s];
    tree_.visit_near(x[m[0]], x[m[1]], own, segment + 1, [&](std::int32_t part, double separation) {
      if (!parts_.may_touch(segment, part)) return;
      const auto other = static_cast<std::size_t>(part);
      listed_.push_back({segment, part, separation + around_[other] + travelled_[s] + travelled_[other]});
    });
  }
  quiet_.resize(listed_.size());
}

bool CompletePairs::examine(Listed& pair, Quiet& quiet, std::span<const Vec3> x, double watched_m,
                            NearPairs& found) noexcept {
  const auto s = static_cast<std::size_t>(pair.segment), p = static_cast<std::size_t>(pair.part);
  const double near = parts_.reach_m(pair.part) + watched_m;
  if (pair.distance_then - ahead_[s] - ahead_[p] > near) return true;
  const double travelled = travelled_[s] + travelled_[p], ahead = ahead_[s] + ahead_[p];
  const auto take = [&](const PairPlaces& places, bool reports) {
    found.pairs.push_back({pair.segment, pair.part, places, reports});
    lower_gap(parts_.masses[s], places.distance_m, found.gap);
    lower_gap(parts_.masses[p], places.distance_m, found.gap);
  };
  if (ahead <= quiet.until) {
    quiet.places.distance_m = std::max(0.0, pair.distance_then - travelled);
    take(quiet.places, false);
    return true;
  }
  const double left = list_until_[s] + list_until_[p] - travelled;
  const PairPlaces places = measure(parts_, x, pair.segment, pair.part, near + left);
  ++tests_;
  pair.distance_then = places.distance_m + travelled;
  if (places.distance_m >= near + ahead - travelled) return places.distance_m < near + left;
  const bool reporting = reports(parts_, pair.segment, pair.part, places);
  take(places, reporting);
  quiet = {reporting ? -1 : travelled + quiet_way(parts_, x, pair.segment, pair.part, places), places};
  return true;
}

void CompletePairs::find(std::span<const Vec3> x, std::span<const double> way_m, double watched_m,
                         NearPairs& found) noexcept {
  const bool first = last_.empty();
  travel(x, way_m);
  if (first || !list_holds()) list_pairs(x, watched_m);
  tests_ = 0;
  found.pairs.clear();
  std::ranges::fill(found.gap, farthest_gap_m());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    if (!examine(listed_[i], quiet_[i], x, watched_m, found)) continue;
    if (kept != i) {
      listed_[kept] = listed_[i];
      quiet_[kept] = quiet_[i];
    }
    ++kept;
  }
  listed_.resize(kept);
  quiet_.resize(kept);
}

}  // namespace omentum::physics
