// Which masses an intestine and its mesentery consist of, and what lies between them.
#pragma once

#include "geometry/types.h"

#include <array>
#include <cstddef>

namespace omentum::geometry {

using MassId = Index<struct MassTag>;  // mass of an intestine and its mesentery, from 0, row by row

/// A grid of masses over the unfolded mesentery (Raghupathi 2004, fig. 6): columns along the gut, rows
/// across. Row 0 is the axis of the gut, the last row lies on the vessel. The vessel's row is held, and so
/// are the first and the last column, all of whose masses are in one place: there the mesentery has no width
/// (the surgeons' correction, section 7). rows >= 2, columns >= 4.
struct GutLayout {
  std::int32_t rows = 4;
  std::int32_t columns = 100;

  constexpr std::int32_t mass_count() const { return rows * columns; }
  constexpr MassId mass(std::int32_t row, std::int32_t column) const {
    return MassId(row * columns + column);
  }
  constexpr std::int32_t row(MassId m) const { return m / columns; }
  constexpr std::int32_t column(MassId m) const { return m % columns; }
  constexpr bool is_held(MassId m) const {
    return row(m) == rows - 1 || column(m) == 0 || column(m) == columns - 1;
  }

  /// Of the gut's axis: segment i goes from mass(0, i) to mass(0, i + 1).
  constexpr std::int32_t segment_count() const { return columns - 1; }
  constexpr std::array<MassId, 2> segment(std::int32_t i) const { return {mass(0, i), mass(0, i + 1)}; }

  /// Of the mesentery: two for each cell (row, column), cells row by row; those beside the first and the last
  /// column that would have no area are there, with two corners in one place.
  constexpr std::int32_t triangle_count() const { return 2 * (rows - 1) * (columns - 1); }
  constexpr std::array<MassId, 3> triangle(std::int32_t t) const {
    const std::int32_t cell = t / 2;
    const std::int32_t r = cell / (columns - 1), c = cell % (columns - 1);
    if (t % 2 == 0) return {mass(r, c), mass(r + 1, c), mass(r, c + 1)};
    return {mass(r, c + 1), mass(r + 1, c), mass(r + 1, c + 1)};
  }

  friend bool operator==(const GutLayout&, const GutLayout&) = default;
};

}  // namespace omentum::geometry
