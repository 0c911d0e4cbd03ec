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

// Balls around parts are kept as floats: this part of a metre is more than what is lost by that.
constexpr float kRounding_m = 1e-6F;

void lower(std::vector<double>& gap, const std::array<MassId, 3>& masses, double distance_m) {
  for (const MassId m : masses) {
    if (m.valid()) gap[static_cast<std::size_t>(m)] = std::min(gap[static_cast<std::size_t>(m)], distance_m);
  }
}

double largest(std::span<const double> of_masses, const std::array<MassId, 3>& masses) {
  const double two = std::max(of_masses[masses[0]], of_masses[masses[1]]);
  return masses[2].valid() ? std::max(two, of_masses[masses[2]]) : two;
}

}  // namespace

CompletePairs::CompletePairs(const GutParts& parts) : parts_(parts) {
  const auto count = static_cast<std::size_t>(parts.count());
  last_.reserve(static_cast<std::size_t>(parts.layout.mass_count()));
  moved_.resize(static_cast<std::size_t>(parts.layout.mass_count()));
  for (auto* of_parts : {&travelled_, &ahead_, &list_until_}) of_parts->resize(count);
  for (auto* of_parts : {&x_, &y_, &z_, &radius_}) of_parts->resize(count);
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
    const std::array<MassId, 3> masses = parts_.masses(part);
    const auto p = static_cast<std::size_t>(part);
    travelled_[p] += largest(moved_, masses);
    ahead_[p] = travelled_[p] + largest(way_m, masses);
  }
}

bool CompletePairs::list_holds() const noexcept {
  return std::ranges::equal(ahead_, list_until_, std::less_equal{});
}

// The ways of this step come on top of the margin, so that a fast mass does not use up the others' list.
void CompletePairs::list_pairs(std::span<const Vec3> x) noexcept {
  for (std::int32_t part = 0; part < parts_.count(); ++part) {
    const auto p = static_cast<std::size_t>(part);
    const Ball ball = parts_.ball_around(part, x);
    x_[p] = static_cast<float>(ball.centre.x());
    y_[p] = static_cast<float>(ball.centre.y());
    z_[p] = static_cast<float>(ball.centre.z());
    list_until_[p] = ahead_[p] + kMargin / 2 * parts_.least_reach_m();
    radius_[p] = static_cast<float>(ball.radius_m + list_until_[p] - travelled_[p]) + kRounding_m;
  }
  listed_.clear();
  for (std::int32_t segment = 0; segment < parts_.layout.segment_count(); ++segment) list_pairs_of(segment);
}

void CompletePairs::list_pairs_of(std::int32_t segment) noexcept {
  const auto s = static_cast<std::size_t>(segment);
  for (auto p = s + 1; p < radius_.size(); ++p) {
    const auto part = static_cast<std::int32_t>(p);
    const float dx = x_[p] - x_[s], dy = y_[p] - y_[s], dz = z_[p] - z_[s];
    const float far = radius_[s] + radius_[p] + static_cast<float>(parts_.reach_m(part));
    if (dx * dx + dy * dy + dz * dz > far * far || !parts_.may_touch(segment, part)) continue;
    listed_.push_back(
        {segment, part,
         std::sqrt(dx * dx + dy * dy + dz * dz) - radius_[s] - radius_[p] + list_until_[s] + list_until_[p]});
  }
}

void CompletePairs::examine(Listed& pair, std::span<const Vec3> x, double watched_m,
                            NearPairs& found) noexcept {
  const auto s = static_cast<std::size_t>(pair.segment), p = static_cast<std::size_t>(pair.part);
  const double near = parts_.reach_m(pair.part) + watched_m;
  if (pair.distance_then - ahead_[s] - ahead_[p] > near) return;
  const double ways = ahead_[s] - travelled_[s] + ahead_[p] - travelled_[p];
  const PairPlaces places = measure(parts_, x, pair.segment, pair.part, near + kMargin * near + ways);
  ++tests_;
  pair.distance_then = places.distance_m + travelled_[s] + travelled_[p];
  if (places.distance_m >= near + ways) return;
  found.pairs.push_back({pair.segment, pair.part, places.distance_m});
  found.contacts.push_back(contact_of(parts_, x, pair.segment, pair.part, places));
  lower(found.gap, parts_.masses(pair.segment), places.distance_m);
  lower(found.gap, parts_.masses(pair.part), places.distance_m);
}

void CompletePairs::find(std::span<const Vec3> x, std::span<const double> way_m, double watched_m,
                         NearPairs& found) noexcept {
  const bool first = last_.empty();
  travel(x, way_m);
  if (first || !list_holds()) list_pairs(x);
  tests_ = 0;
  found.pairs.clear();
  found.contacts.clear();
  std::ranges::fill(found.gap, farthest_gap_m());
  for (Listed& pair : listed_) examine(pair, x, watched_m, found);
}

}  // namespace omentum::physics
