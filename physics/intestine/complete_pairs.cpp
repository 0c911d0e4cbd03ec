#include "physics/intestine/complete_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// Of the least reach: how much farther than needed pairs are listed. Less makes lists more often, more makes
// them longer.
constexpr double kMargin = 0.4;
// So many steps as this one a list is to last beyond that: what is fast uses up no more than its own list.
constexpr double kLasting = 4;

}  // namespace

CompletePairs::CompletePairs(const GutParts& parts)
    : parts_(parts), tree_(parts.count()), awake_(PairBatch::kMost) {
  const auto count = static_cast<std::size_t>(parts.count()),
             all = static_cast<std::size_t>(parts.layout.segment_count()) * count;
  last_.reserve(static_cast<std::size_t>(parts.gut.mass_count()));
  moved_.resize(static_cast<std::size_t>(parts.gut.mass_count()));
  for (auto* of_parts : {&travelled_, &ahead_, &list_until_, &around_}) of_parts->resize(count);
  segments_.reserve(all);
  others_.reserve(all);
  slack_.reserve(all);
  quiet_until_.reserve(all);
  quiet_.reserve(all);
}

void CompletePairs::reset() noexcept {
  last_.clear();
  for (auto* of_pairs : {&segments_, &others_}) of_pairs->clear();
  given_up_ = 0;
  for (auto* of_parts : {&travelled_, &ahead_, &list_until_}) std::ranges::fill(*of_parts, 0);
}

void CompletePairs::take_up(const PairFinder& other) noexcept {
  const auto& from = static_cast<const CompletePairs&>(other);
  last_ = from.last_;
  travelled_ = from.travelled_;
  list_until_ = from.list_until_;
  segments_ = from.segments_;
  others_ = from.others_;
  slack_ = from.slack_;
  quiet_until_ = from.quiet_until_;
  quiet_.resize(from.quiet_.size());
  for (std::size_t pair = 0; pair < quiet_.size(); ++pair)
    if (quiet_until_[pair] >= 0) quiet_[pair] = from.quiet_[pair];
  given_up_ = from.given_up_;
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

void CompletePairs::list_pairs(std::span<const Vec3> x, double watched_m) noexcept {
  for (std::size_t p = 0; p < around_.size(); ++p) {
    const double way = ahead_[p] - travelled_[p];
    list_until_[p] = ahead_[p] + kLasting * way + kMargin / 2 * parts_.least_reach_m();
    around_[p] = list_until_[p] - travelled_[p] + parts_.reach_m(static_cast<std::int32_t>(p)) + watched_m;
  }
  tree_.place(parts_, x, around_);
  for (auto* of_pairs : {&segments_, &others_}) of_pairs->clear();
  slack_.clear();
  given_up_ = 0;
  for (std::int32_t segment = 0; segment < parts_.layout.segment_count(); ++segment) {
    const auto s = static_cast<std::size_t>(segment);
    const std::array<MassId, 3>& m = parts_.masses[s];
    const double own = list_until_[s] - travelled_[s];
    tree_.visit_near(x[m[0]], x[m[1]], own, segment + 1, [&](std::int32_t part, double separation) {
      if (!parts_.may_touch(segment, part)) return;
      segments_.push_back(segment);
      others_.push_back(part);
      slack_.push_back(separation + list_until_[static_cast<std::size_t>(part)] + travelled_[s]);
    });
  }
  quiet_until_.assign(slack_.size(), -1);
  quiet_.resize(slack_.size());
}

void CompletePairs::take(std::size_t pair, const PairPlaces& places, bool reports,
                         NearPairs& found) const noexcept {
  const std::int32_t segment = segments_[pair], part = others_[pair];
  found.pairs.push_back({segment, part, places, reports});
  lower_gap(parts_.masses[static_cast<std::size_t>(segment)], places.distance_m, found.gap);
  lower_gap(parts_.masses[static_cast<std::size_t>(part)], places.distance_m, found.gap);
}

// Of a pair that was just measured.
void CompletePairs::judge(std::size_t pair, const PairPlaces& places, std::span<const Vec3> x, double near_m,
                          NearPairs& found) noexcept {
  const double travelled = sum(travelled_, pair), still = places.distance_m - near_m;
  slack_[pair] = still + travelled;
  if (slack_[pair] >= sum(list_until_, pair)) {
    slack_[pair] = std::numeric_limits<double>::infinity();
    ++given_up_;
  }
  if (slack_[pair] >= sum(ahead_, pair)) return;
  const std::int32_t segment = segments_[pair], part = others_[pair];
  const bool reporting = reports(parts_, segment, part, places);
  take(pair, places, reporting, found);
  quiet_until_[pair] = reporting ? -1 : travelled + quiet_way(parts_, x, segment, part, places);
  if (!reporting) quiet_[pair] = places;
}

// Asks for the distance of a pair that is not quiet.
void CompletePairs::ask(std::int32_t& awake, std::size_t first, double watched_m) noexcept {
  const std::size_t pair = first + static_cast<std::size_t>(awake);
  if (sum(ahead_, pair) <= quiet_until_[pair]) {
    awake = ~awake;
    return;
  }
  const double left = sum(list_until_, pair) - sum(travelled_, pair);
  batch_.ask(parts_, segments_[pair], others_[pair], near_m(pair, watched_m) + left);
}

// Of the listed pairs from `first` on.
void CompletePairs::examine(std::size_t first, std::size_t count, std::span<const Vec3> x, double watched_m,
                            NearPairs& found) noexcept {
  const std::span<std::int32_t> awake = std::span(awake_).first(kernels::find_awake(
      count, &slack_[first], &segments_[first], &others_[first], ahead_.data(), awake_.data()));
  batch_.clear();
  for (std::int32_t& i : awake) ask(i, first, watched_m);
  batch_.measure(x);
  tests_ += static_cast<std::int64_t>(batch_.size());
  for (const std::int32_t i : awake) {
    const bool is_quiet = i < 0;
    const std::size_t pair = first + static_cast<std::size_t>(is_quiet ? ~i : i);
    if (!is_quiet) {
      judge(pair, batch_.next(parts_, others_[pair]), x, near_m(pair, watched_m), found);
      continue;
    }
    PairPlaces& known = quiet_[pair];
    known.distance_m = std::max(0.0, slack_[pair] + near_m(pair, watched_m) - sum(travelled_, pair));
    take(pair, known, false, found);
  }
}

void CompletePairs::find(std::span<const Vec3> x, std::span<const double> way_m, double watched_m,
                         NearPairs& found) noexcept {
  const bool first = last_.empty();
  travel(x, way_m);
  if (first || !list_holds()) list_pairs(x, watched_m);
  tests_ = 0;
  found.pairs.clear();
  std::ranges::fill(found.gap, farthest_gap_m());
  for (std::size_t i = 0; i < segments_.size(); i += PairBatch::kMost)
    examine(i, std::min(PairBatch::kMost, segments_.size() - i), x, watched_m, found);
}

}  // namespace omentum::physics
