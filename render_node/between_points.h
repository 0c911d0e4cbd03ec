// What is known at points of a line, in between.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace omentum::render {

/// Linear between the points before and behind u, which counts them from 0; at least two.
template <class Real>
float between(std::span<const Real> of_points, double u) {
  const double i = std::clamp(std::floor(u), 0.0, static_cast<double>(of_points.size() - 2));
  const auto before = static_cast<std::size_t>(i);
  return static_cast<float>(std::lerp(of_points[before], of_points[before + 1], u - i));
}

}  // namespace omentum::render
