#include "geometry/gut_fit.h"

#include <algorithm>
#include <cmath>

namespace omentum::geometry {
namespace {

constexpr double kSameLength = 1e-11, kRounding = 1e-15;  // m
constexpr int kMostTries = 100;

/// A zero of a function that grows from below 0 at `low` to above 0 at `high`: false position, the value at
/// the end that stays put halved (Dowell and Jarratt 1971, "Illinois").
template <class Function>
double zero_between(double low, double low_value, double high, double high_value, double close_enough,
                    const Function& function) {
  for (int i = 0; i < kMostTries && high - low > kRounding; ++i) {
    const double middle = (low * high_value - high * low_value) / (high_value - low_value);
    const double value = function(middle);
    if (std::abs(value) <= close_enough) return middle;
    if (value < 0) {
      low = middle, low_value = value, high_value /= 2;
    } else {
      high = middle, high_value = value, low_value /= 2;
    }
  }
  return high;
}

// The first place behind u that is `chord` from point(u); nothing where the curve ends before.
std::optional<double> next_place(const GutCurve& curve, double u, double chord) {
  const Vec3 from = curve.point(u);
  const auto beyond = [&](double v) { return (curve.point(v) - from).norm() - chord; };
  double low = u, low_value = -chord;
  for (;;) {
    const double high = std::min(low + chord / 2, curve.length_m());
    const double high_value = beyond(high);
    if (high_value >= 0) return zero_between(low, low_value, high, high_value, kRounding, beyond);
    if (high >= curve.length_m()) return std::nullopt;
    low = high, low_value = high_value;
  }
}

std::vector<double> equal_chords(const GutCurve& curve, double chord) {
  std::vector<double> places{0};
  while (const auto next = next_place(curve, places.back(), chord)) places.push_back(*next);
  return places;
}

// Of the chords from start to end, the last one as long as it happens to be.
double polygon_length(const GutCurve& curve, double chord) {
  const std::vector<double> places = equal_chords(curve, chord);
  const double rest = (curve.point(curve.length_m()) - curve.point(places.back())).norm();
  return static_cast<double>(places.size() - 1) * chord + rest;
}

}  // namespace

std::optional<GutFit> fit_legs(GutFolds folds, std::int32_t sides, double side_m) {
  const double length = sides * side_m;
  const auto excess = [&](double leg_m) {
    folds.leg_m = leg_m;
    return polygon_length(GutCurve(folds), side_m) - length;
  };
  const double least = folds.leg_m, least_value = excess(least);
  if (least_value > 0) return std::nullopt;
  double most = least, most_value = least_value;
  for (; most_value <= 0; most += length / folds.legs) most_value = excess(most + length / folds.legs);
  folds.leg_m = zero_between(least, least_value, most, most_value, kSameLength, excess);
  GutFit fit{GutCurve(folds), {}};
  fit.places = equal_chords(fit.curve, side_m);
  // the last side ends at the curve's end or, by rounding, a hair before
  fit.places.resize(static_cast<std::size_t>(sides));
  fit.places.push_back(fit.curve.length_m());
  return fit;
}

}  // namespace omentum::geometry
