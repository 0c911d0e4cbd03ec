#include "physics/intestine/active_pairs.h"

#include <algorithm>
#include <limits>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// Followed up to this multiple of the reach, so that a pair is known before it collides.
constexpr double kThreshold = 1.4;

// How far a new pair looks at first, in segments: a fold's leg is a few times as long.
constexpr std::int32_t kFirstStride = 8;

// Pairs that there is room for, for each part of the gut.
constexpr std::size_t kPairsPerPart = 48;

// Triangle of the mesentery in a cell, upper: with an even number; none outside.
std::int32_t triangle_at(const GutParts& parts, std::int32_t row, std::int32_t column, bool lower) {
  const geometry::GutLayout& layout = parts.layout;
  if (row < 0 || column < 0 || row >= layout.rows - 1 || column >= layout.columns - 1) return -1;
  return layout.segment_count() + 2 * (row * (layout.columns - 1) + column) + (lower ? 1 : 0);
}

struct Cell {
  std::int32_t row, column;
  bool lower;
};

Cell cell_of(const GutParts& parts, std::int32_t part) {
  const std::int32_t t = part - parts.layout.segment_count(), cells = parts.layout.columns - 1;
  return {t / 2 / cells, t / 2 % cells, t % 2 == 1};
}

// Those that have an edge in common with a triangle.
std::array<std::int32_t, 3> beside(const GutParts& parts, std::int32_t part) {
  const auto [r, c, lower] = cell_of(parts, part);
  const std::int32_t step = lower ? 1 : -1;
  return {triangle_at(parts, r, c, !lower), triangle_at(parts, r, c + step, !lower),
          triangle_at(parts, r + step, c, !lower)};
}

// All around a mass.
std::array<std::int32_t, 6> around(const GutParts& parts, MassId m) {
  const std::int32_t r = parts.layout.row(m), c = parts.layout.column(m);
  return {triangle_at(parts, r - 1, c - 1, true), triangle_at(parts, r - 1, c, false),
          triangle_at(parts, r - 1, c, true),     triangle_at(parts, r, c - 1, false),
          triangle_at(parts, r, c - 1, true),     triangle_at(parts, r, c, false)};
}

}  // namespace

ActivePairs::ActivePairs(const GutParts& parts, std::int32_t new_pairs, std::uint64_t seed)
    : parts_(parts),
      most_(kPairsPerPart * static_cast<std::size_t>(parts.count())),
      new_pairs_(new_pairs),
      seed_(seed),
      random_(seed),
      memory_(most_),
      merged_(most_),
      threshold_m_(kThreshold) {
  active_.reserve(most_);
  area_.reserve(most_);
}

void ActivePairs::reset() noexcept {
  active_.clear();
  random_ = seed_;
}

void ActivePairs::take_up(const PairFinder& other) noexcept {
  const auto& same = static_cast<const ActivePairs&>(other);
  active_ = same.active_;
  random_ = same.random_;
}

// SplitMix64 (Steele, Lea and Flood 2014), its upper bits scaled to the range.
std::uint64_t ActivePairs::random_below(std::uint64_t end) noexcept {
  std::uint64_t z = random_ += 0x9E3779B97F4A7C15U;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
  z = (z ^ z >> 27) * 0x94D049BB133111EBU;
  return ((z ^ z >> 31) >> 32) * end >> 32;
}

void ActivePairs::add_random_pair(bool of_axis) noexcept {
  const auto segments = static_cast<std::uint64_t>(parts_.layout.segment_count());
  const auto sheet = static_cast<std::uint64_t>(parts_.layout.triangle_count());
  auto segment = static_cast<std::int32_t>(random_below(segments));
  auto part = static_cast<std::int32_t>(of_axis ? random_below(segments) : segments + random_below(sheet));
  if (of_axis && part < segment) std::swap(segment, part);
  if (!parts_.may_touch(segment, part) || active_.size() == active_.capacity()) return;
  active_.push_back({segment, part, kFirstStride, std::numeric_limits<double>::infinity()});
}

// Measures a pair that may touch, once in a step; none for one that may not, or when memory is full.
ActivePairs::Memory::Entry* ActivePairs::test(std::int32_t segment, std::int32_t part) noexcept {
  if (parts_.is_segment(part) && part < segment) std::swap(segment, part);
  if (segment < 0 || part < 0 || segment >= parts_.layout.segment_count() || part >= parts_.count())
    return nullptr;
  if (!parts_.may_touch(segment, part)) return nullptr;
  const auto [entry, is_new] = memory_.remember(segment, part);
  if (is_new) {
    entry->value.places = measure(parts_, x_, segment, part, std::numeric_limits<double>::infinity());
    ++tests_;
  }
  return entry;
}

void ActivePairs::try_pair(std::int32_t segment, std::int32_t part, Active& best) noexcept {
  const Memory::Entry* const entry = test(segment, part);
  if (entry == nullptr || entry->value.places.distance_m >= best.distance_m) return;
  best = {entry->segment, entry->part, best.stride, entry->value.places.distance_m};
}

void ActivePairs::look_along_axis(Active& pair) noexcept {
  const Active old = pair;
  const std::int32_t h = std::max(old.stride, 1), last = parts_.layout.segment_count() - 1;
  for (const std::int32_t i : {-h, 0, h}) {
    for (const std::int32_t j : {-h, 0, h}) {
      if (old.part + j <= last) try_pair(old.segment + i, old.part + j, pair);
    }
  }
}

void ActivePairs::look_over_sheet(Active& pair) noexcept {
  const std::int32_t h = std::max(pair.stride, 1), segment = pair.segment;
  try_pair(segment - h, pair.part, pair);
  try_pair(segment + h, pair.part, pair);
  const Active old = pair;
  if (h > 1) {
    const auto [r, c, lower] = cell_of(parts_, old.part);
    for (const std::int32_t column : {c - h, c + h})
      try_pair(old.segment, triangle_at(parts_, r, column, lower), pair);
    for (const std::int32_t row : {r - 1, r + 1})
      try_pair(old.segment, triangle_at(parts_, row, c, lower), pair);
    return;
  }
  const Memory::Entry* const entry = test(old.segment, old.part);
  if (entry == nullptr || entry->value.places.other.minCoeff() > 0) return;
  Eigen::Index corner = 0;
  entry->value.places.other.maxCoeff(&corner);
  const std::int32_t triangle = old.part - parts_.layout.segment_count();
  for (const std::int32_t part :
       around(parts_, parts_.layout.triangle(triangle)[static_cast<std::size_t>(corner)]))
    try_pair(old.segment, part, pair);
}

// One update; false when the pair is to be dropped.
bool ActivePairs::settle(Active& pair) noexcept {
  const Memory::Entry* const here = test(pair.segment, pair.part);
  if (here == nullptr) return false;
  pair.distance_m = here->value.places.distance_m;
  const Active old = pair;
  parts_.is_segment(pair.part) ? look_along_axis(pair) : look_over_sheet(pair);
  const bool moved = old.segment != pair.segment || old.part != pair.part;
  if (!moved) pair.stride /= 2;
  const bool settled = !moved && pair.stride == 0;
  if (settled && pair.distance_m > threshold_m_ * parts_.reach_m(pair.part)) return false;
  return merged_.remember(pair.segment, pair.part).second;
}

void ActivePairs::join_area(std::int32_t segment, std::int32_t part) noexcept {
  Memory::Entry* const entry = test(segment, part);
  if (entry == nullptr || entry->value.looked_at) return;
  entry->value.looked_at = true;
  area_.push_back(entry);
}

void ActivePairs::spread(std::int32_t segment, std::int32_t part, std::span<const double> way_m,
                         double watched_m, NearPairs& found) noexcept {
  join_area(segment, part);
  while (!area_.empty()) {
    const Memory::Entry entry = *area_.back();
    area_.pop_back();
    const std::array<MassId, 3>&one = parts_.masses[static_cast<std::size_t>(entry.segment)],
                             &other = parts_.masses[static_cast<std::size_t>(entry.part)];
    const double distance = entry.value.places.distance_m;
    if (distance >=
        parts_.reach_m(entry.part) + watched_m + largest_of(one, way_m) + largest_of(other, way_m))
      continue;
    found.pairs.push_back({entry.segment, entry.part, entry.value.places,
                           reports(parts_, entry.segment, entry.part, entry.value.places)});
    lower_gap(one, distance, found.gap);
    lower_gap(other, distance, found.gap);
    for (const std::int32_t step : {-1, 1}) join_area(entry.segment + step, entry.part);
    if (!parts_.is_segment(entry.part)) {
      for (const std::int32_t next : beside(parts_, entry.part)) join_area(entry.segment, next);
      continue;
    }
    for (const std::int32_t step : {-1, 1}) {
      if (parts_.is_segment(entry.part + step)) join_area(entry.segment, entry.part + step);
    }
  }
}

void ActivePairs::find(std::span<const Vec3> x, std::span<const double> way_m, double watched_m,
                       NearPairs& found) noexcept {
  x_ = x;
  tests_ = 0;
  memory_.forget();
  merged_.forget();
  found.pairs.clear();
  std::ranges::fill(found.gap, farthest_gap_m());
  for (std::int32_t n = 0; n < new_pairs_; ++n) add_random_pair(n % 2 == 0);
  std::erase_if(active_, [&](Active& pair) { return !settle(pair); });
  for (const Active& pair : active_) spread(pair.segment, pair.part, way_m, watched_m, found);
}

}  // namespace omentum::physics
