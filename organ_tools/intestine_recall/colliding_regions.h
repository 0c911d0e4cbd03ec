// Where an intestine collides: pairs of parts, gathered into regions.
#pragma once

#include "geometry/gut_intersections.h"

#include <compare>
#include <vector>

namespace omentum::intestine_recall {

/// A segment of the axis, and another one (row kOfAxis, column its number, above `segment`) or the
/// mesentery's cell at row and column.
struct IndexPair {
  static constexpr std::int32_t kOfAxis = -2;  // beside no row of cells
  std::int32_t segment = 0, row = kOfAxis, column = 0;
  friend auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

IndexPair axis_pair(std::int32_t segment, std::int32_t other);
IndexPair cell_pair(const geometry::GutLayout& layout, std::int32_t segment, std::int32_t triangle);

/// The pair itself and its neighbours: those whose three numbers differ by at most one.
std::array<IndexPair, 27> around(const IndexPair& pair);

/// Connected components of the overlapping pairs in index space (the regions of Raghupathi 2004, fig. 14):
/// each with its pairs in order, the regions by their first pair.
using Region = std::vector<IndexPair>;
std::vector<Region> regions_of(const geometry::GutLayout& layout, const geometry::GutOverlaps& overlaps);

}  // namespace omentum::intestine_recall
