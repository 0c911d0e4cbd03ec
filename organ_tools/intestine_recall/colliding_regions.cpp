#include "organ_tools/intestine_recall/colliding_regions.h"

#include <algorithm>
#include <set>

namespace omentum::intestine_recall {
namespace {

// Takes what hangs together with `first` out of `left`.
Region take_region(const IndexPair& first, std::set<IndexPair>& left) {
  Region region{first};
  left.erase(first);
  for (std::size_t next = 0; next < region.size(); ++next) {
    for (const IndexPair& pair : around(region[next]))
      if (left.erase(pair) > 0) region.push_back(pair);
  }
  std::ranges::sort(region);
  return region;
}

}  // namespace

IndexPair axis_pair(std::int32_t segment, std::int32_t other) {
  return {std::min(segment, other), IndexPair::kOfAxis, std::max(segment, other)};
}

IndexPair cell_pair(const geometry::GutLayout& layout, std::int32_t segment, std::int32_t triangle) {
  return {segment, triangle / 2 / layout.segment_count(), geometry::segment_above(layout, triangle)};
}

std::array<IndexPair, 27> around(const IndexPair& pair) {
  std::array<IndexPair, 27> found;
  std::size_t n = 0;
  for (std::int32_t s = -1; s <= 1; ++s)
    for (std::int32_t r = -1; r <= 1; ++r)
      for (std::int32_t c = -1; c <= 1; ++c) found[n++] = {pair.segment + s, pair.row + r, pair.column + c};
  return found;
}

std::vector<Region> regions_of(const geometry::GutLayout& layout, const geometry::GutOverlaps& overlaps) {
  std::set<IndexPair> left;
  for (const geometry::GutOverlap& o : overlaps.tube) left.insert(axis_pair(o.segment, o.other));
  for (const geometry::GutOverlap& o : overlaps.mesentery) left.insert(cell_pair(layout, o.segment, o.other));
  std::vector<Region> regions;
  while (!left.empty()) regions.push_back(take_region(*left.begin(), left));
  return regions;
}

}  // namespace omentum::intestine_recall
