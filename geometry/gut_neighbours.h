// Which parts of an intestine and its mesentery may touch at all.
#pragma once

#include "geometry/gut_shape.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace omentum::geometry {

/// Two places of the axis that lie below pi r from each other ALONG it, half of the tightest turn that a tube
/// of radius r can make, never count as a collision: bending keeps them apart. A triangle of the mesentery
/// hangs on the segment of its columns, in all rows, and counts as that segment does. Two triangles of the
/// mesentery never count (Raghupathi 2004, section 4.1). Masses are equally far from each other along the
/// axis, so columns tell the distance.
struct GutNeighbourhood {
  std::int32_t columns_apart = 3;  // from here on two segments may touch

  constexpr bool may_touch(std::int32_t segment, std::int32_t other) const {
    return std::abs(segment - other) >= columns_apart;
  }
};

/// The segment of the axis on which triangle t hangs (GutLayout::triangle).
constexpr std::int32_t segment_above(const GutLayout& layout, std::int32_t t) {
  return t / 2 % layout.segment_count();
}

/// Between segments i < j lie j - i - 1 others, each segment_m long. Precondition: segment_m > 0.
inline GutNeighbourhood neighbourhood(double segment_m, double tube_radius_m) {
  return {1 + static_cast<std::int32_t>(std::ceil(std::numbers::pi * tube_radius_m / segment_m))};
}

/// Of the axis as it is at the start: its mean segment.
inline GutNeighbourhood neighbourhood(const GutShape& shape) {
  double length_m = 0;
  for (std::int32_t i = 0; i < shape.layout.segment_count(); ++i) {
    const auto [a, b] = shape.layout.segment(i);
    length_m +=
        (shape.positions[static_cast<std::size_t>(b)] - shape.positions[static_cast<std::size_t>(a)]).norm();
  }
  return neighbourhood(length_m / shape.layout.segment_count(), shape.tube_radius_m);
}

}  // namespace omentum::geometry
