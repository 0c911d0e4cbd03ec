#include "geometry/tube_split.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <array>
#include <limits>

namespace omentum::geometry {
namespace {

constexpr std::size_t kPlaces = 5;  // of a segment, at which curvatures are compared
constexpr double kAtMass = -1;

// Of the curvature.
double squared_curvature(const AxisCubic& segment, double t) {
  const Vec3 slope = segment.b + t * (2 * segment.c + 3 * t * segment.d);
  const Vec3 turn = slope.cross(2 * segment.c + 6 * t * segment.d);
  const double squared = slope.squaredNorm();
  return turn.squaredNorm() / std::max(squared * squared * squared, std::numeric_limits<double>::min());
}

}  // namespace

double sharpest(const AxisCubic& segment) {
  constexpr double kStep = 1.0 / (kPlaces - 1);
  std::array<double, kPlaces> bend;
  for (std::size_t j = 0; j < kPlaces; ++j)
    bend[j] = squared_curvature(segment, kStep * static_cast<double>(j));
  const auto most = static_cast<std::size_t>(std::ranges::max_element(bend) - bend.begin());
  const double t = kStep * static_cast<double>(most);
  if (most == 0 || most + 1 == kPlaces) return t;
  const double before = bend[most - 1], at = bend[most], after = bend[most + 1];
  const double opening = 2 * at - before - after;
  return opening > 0 ? t + kStep * 0.5 * (after - before) / opening : t;
}

TubeSplit::TubeSplit(std::size_t mass_count)
    : turns_(mass_count), inner_(mass_count - 1), peak_(mass_count), is_cut_(mass_count - 1) {
  cuts_.reserve(kMostCuts * mass_count);
}

void TubeSplit::split(const TubeAxis& axis, double eps, std::span<const std::uint8_t> wanted) {
  require(turns_.size() == static_cast<std::size_t>(axis.end()) + 1, "an axis of as many masses");
  require(eps > 0, "a threshold above 0");
  require(wanted.empty() || wanted.size() == is_cut_.size(), "a word for each segment");
  for (std::size_t i = 0; i < turns_.size(); ++i) turns_[i] = axis.turn_at(i);
  find_peaks(axis, eps);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i] != 0) is_cut_[i] = 1;
  cuts_.clear();
  for (std::size_t segment = 0; segment < is_cut_.size(); ++segment) cut(segment);
  cuts_.push_back(axis.end());
}

void TubeSplit::find_peaks(const TubeAxis& axis, double eps) {
  std::ranges::fill(peak_, std::uint8_t{0});
  for (std::size_t i = 0; i < is_cut_.size(); ++i) {
    inner_[i] = kAtMass;
    is_cut_[i] = turns_[i] >= eps || turns_[i + 1] >= eps ? 1 : 0;
    if (is_cut_[i] == 0) continue;
    const double m = sharpest(axis.cubic(i));
    if (m > 0 && m < 1) {
      inner_[i] = m;
    } else {
      peak_[m > 0 ? i + 1 : i] = 1;
    }
  }
  peak_.front() = peak_.back() = 0;  // a cap needs its frame
}

// The cuts of a segment, and where it begins; where it ends is the next one's.
void TubeSplit::cut(std::size_t segment) {
  const auto u = static_cast<double>(segment);
  const bool over_first = peak_[segment] != 0, over_last = peak_[segment + 1] != 0;
  const auto add = [&](double t) { cuts_.push_back(u + t); };
  if (!over_first) add(0);
  if (const double m = inner_[segment]; m > 0) {
    if (over_first) add(m / 3);
    add(m - m / 3);
    add(m + (1 - m) / 3);
    if (over_last) add(1 - (1 - m) / 3);
  } else if (is_cut_[segment] != 0 || over_first || over_last) {
    add(1.0 / kThirds);
    add(2.0 / kThirds);
  }
}

}  // namespace omentum::geometry
