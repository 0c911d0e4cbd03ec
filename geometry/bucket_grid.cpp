#include "geometry/bucket_grid.h"

#include "geometry/closest_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace omentum::geometry {
namespace {

// Slots for each triangle, at least: a closed surface of F triangles touches about 3 F buckets when each is
// as large as a triangle's edge.
constexpr std::size_t kSlotsPerTriangle = 4;

// Cell coordinates stay below this, so that sums and products with them cannot overflow.
constexpr double kFarthestCell = 1 << 28;

// Queries are grown by this part of a bucket: a thousand times the rounding of a cell boundary.
constexpr double kRoundingPad = 1e-9;

// Slack as part of the mean edge. Of 1/8, 1/4, 1/2 and 3/4 measured under a sliding dent on a fine liver:
// less saves nothing on updates worth having, at 1/2 a query looks at three times as many triangles.
constexpr double kSuitableSlack = 0.25;

// Entries along each side of a triangle's block, at most: eight times the mean edge. Longer triangles of a
// mesh that is graded so steeply live in the overflow list; their blocks would take all memory.
constexpr std::int32_t kLargestSide = 8;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double mean_edge(const Surface& surface, std::span<const Vec3> positions) {
  double sum = 0;
  for (const Triangle& t : surface.triangles) {
    for (int i = 0; i < 3; ++i) sum += (positions[t[i]] - positions[t[(i + 1) % 3]]).norm();
  }
  return sum / (3.0 * static_cast<double>(std::max<std::size_t>(surface.triangles.size(), 1)));
}

}  // namespace

double BucketGrid::suitable_slack(const Surface& surface, std::span<const Vec3> positions) {
  return kSuitableSlack * mean_edge(surface, positions);
}

BucketGrid::BucketGrid(const Surface& surface, std::span<const Vec3> positions, double slack_m)
    : surface_(&surface), edge_(mean_edge(surface, positions)), slack_(slack_m), cells_per_metre_(1 / edge_) {
  if (!(slack_ > 0 && slack_ < edge_)) {
    throw std::invalid_argument("bucket grid: found a slack of " + std::to_string(slack_) +
                                " m, expected more than 0 and less than the bucket edge, " +
                                std::to_string(edge_) + " m");
  }
  const std::size_t count = surface.triangles.size();
  bits_ = 1;
  while ((std::size_t{1} << (3 * bits_)) < kSlotsPerTriangle * count) ++bits_;
  overflow_slot_ = std::int32_t{1} << (3 * bits_);
  heads_.assign(static_cast<std::size_t>(overflow_slot_) + 1, -1);
  std::int32_t next_entry = 0;
  for (const Triangle& t : surface.triangles) {
    double longest = 0;
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, (positions[t[i]] - positions[t[(i + 1) % 3]]).norm());
    const double widest = kStretch * longest + 2 * slack_;
    const auto side = 1 + static_cast<std::int32_t>(
                              std::ceil(std::min<double>(widest * cells_per_metre_, kLargestSide - 1)));
    blocks_.push_back({next_entry, side});
    next_entry += side * side * side + 1;  // the last one is for the overflow list
  }
  entries_.resize(static_cast<std::size_t>(next_entry), {-1, -1, -1});
  boxes_.assign(count, {Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)});
  bounds_ = {Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
  ranges_.resize(count);
  in_overflow_.assign(count, false);
  seen_.assign(count, 0);
  candidates_.reserve(count);
  for (std::size_t t = 0; t < count; ++t) update(TriangleId(t), positions);
}

std::int32_t BucketGrid::coordinate(double x) const noexcept {
  return static_cast<std::int32_t>(
      std::floor(std::clamp(x * cells_per_metre_, -kFarthestCell, kFarthestCell)));
}

// Cells are laid out like a torus: two share a slot only when they are 2^bits_ apart along each axis.
std::int32_t BucketGrid::slot_of(const Cell& cell) const noexcept {
  const std::int32_t mask = (std::int32_t{1} << bits_) - 1;
  return (cell[0] & mask) | (cell[1] & mask) << bits_ | (cell[2] & mask) << (2 * bits_);
}

std::int32_t BucketGrid::entry_of(const Block& block, const Cell& cell) const noexcept {
  const auto wrap = [&](std::int32_t c) { return (c % block.side + block.side) % block.side; };
  return block.first + wrap(cell[0]) + block.side * (wrap(cell[1]) + block.side * wrap(cell[2]));
}

void BucketGrid::link(std::int32_t entry, std::int32_t slot, std::int32_t triangle) noexcept {
  std::int32_t& head = heads_[static_cast<std::size_t>(slot)];
  entries_[static_cast<std::size_t>(entry)] = {~slot, head, triangle};
  if (head >= 0) entries_[static_cast<std::size_t>(head)].previous = entry;
  head = entry;
}

void BucketGrid::unlink(std::int32_t entry) noexcept {
  const Entry e = entries_[static_cast<std::size_t>(entry)];
  if (e.next >= 0) entries_[static_cast<std::size_t>(e.next)].previous = e.previous;
  if (e.previous >= 0) {
    entries_[static_cast<std::size_t>(e.previous)].next = e.next;
  } else {
    heads_[static_cast<std::size_t>(~e.previous)] = e.next;
  }
}

void BucketGrid::rebin(std::int32_t triangle, const CellRange& cells) noexcept {
  const auto index = static_cast<std::size_t>(triangle);
  const Block& block = blocks_[index];
  const CellRange old = ranges_[index];
  ranges_[index] = cells;
  const auto for_each_not_in = [](const CellRange& range, const CellRange& other, auto&& act) {
    for (std::int32_t z = range.low[2]; z <= range.high[2]; ++z) {
      for (std::int32_t y = range.low[1]; y <= range.high[1]; ++y) {
        for (std::int32_t x = range.low[0]; x <= range.high[0]; ++x) {
          if (!other.contains({x, y, z})) act(Cell{x, y, z});
        }
      }
    }
  };
  for_each_not_in(old, cells, [&](const Cell& cell) { unlink(entry_of(block, cell)); });
  for_each_not_in(cells, old,
                  [&](const Cell& cell) { link(entry_of(block, cell), slot_of(cell), triangle); });
}

void BucketGrid::move_triangle(TriangleId triangle, const Vec3& low, const Vec3& high) noexcept {
  const auto index = static_cast<std::size_t>(triangle);
  const Block& block = blocks_[index];
  const bool finite = low.allFinite() && high.allFinite();
  CellRange cells;
  bool overflows = false;
  if (finite) {
    boxes_[index] = {low.array() - slack_, high.array() + slack_};
    bounds_.low = bounds_.low.cwiseMin(boxes_[index].low);
    bounds_.high = bounds_.high.cwiseMax(boxes_[index].high);
    cells = {cell_of(boxes_[index].low), cell_of(boxes_[index].high)};
    for (int i = 0; i < 3; ++i) overflows |= cells.high[i] - cells.low[i] >= block.side;
  } else {
    boxes_[index] = {Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
  }
  rebin(triangle, overflows ? CellRange{} : cells);
  if (overflows == in_overflow_[index]) return;
  const std::int32_t entry = block.first + block.side * block.side * block.side;
  overflows ? link(entry, overflow_slot_, triangle) : unlink(entry);
  overflow_count_ += overflows ? 1 : -1;
  in_overflow_[index] = overflows;
}

void BucketGrid::begin_query() noexcept {
  candidates_.clear();
  if (++query_ != 0) return;
  std::fill(seen_.begin(), seen_.end(), 0);  // the counter wrapped: old marks would look new
  query_ = 1;
}

void BucketGrid::collect_triangle(std::int32_t triangle, const Box& box) noexcept {
  const auto index = static_cast<std::size_t>(triangle);
  const Box& own = boxes_[index];
  if ((own.low.array() > box.high.array()).any() || (own.high.array() < box.low.array()).any()) return;
  if (seen_[index] == query_) return;
  seen_[index] = query_;
  candidates_.push_back(TriangleId(triangle));
}

void BucketGrid::collect_slot(std::int32_t slot, const Box& box) noexcept {
  for (std::int32_t e = heads_[static_cast<std::size_t>(slot)]; e >= 0;
       e = entries_[static_cast<std::size_t>(e)].next) {
    collect_triangle(entries_[static_cast<std::size_t>(e)].triangle, box);
  }
}

void BucketGrid::collect_cells(const CellRange& cells, const Box& box) noexcept {
  for (std::int32_t z = cells.low[2]; z <= cells.high[2]; ++z) {
    for (std::int32_t y = cells.low[1]; y <= cells.high[1]; ++y) {
      for (std::int32_t x = cells.low[0]; x <= cells.high[0]; ++x) collect_slot(slot_of({x, y, z}), box);
    }
  }
}

void BucketGrid::collect_all(const Box& box) noexcept {
  for (std::size_t t = 0; t < boxes_.size(); ++t) collect_triangle(static_cast<std::int32_t>(t), box);
}

// Walks the buckets in layers across the segment's dominant axis: in each layer lies a short piece of the
// segment, and the buckets around the piece's bounding box are looked through.
std::span<const TriangleId> BucketGrid::segment_candidates(const Vec3& p, const Vec3& q,
                                                           double radius_m) noexcept {
  begin_query();
  if (!p.allFinite() || !q.allFinite() || !std::isfinite(radius_m)) return {};
  const double pad = std::max(radius_m, 0.0) + kRoundingPad * edge_;
  const Box box{p.cwiseMin(q).cwiseMax(bounds_.low).array() - pad,
                p.cwiseMax(q).cwiseMin(bounds_.high).array() + pad};
  if ((box.low.array() > box.high.array()).any()) return {};

  Eigen::Index axis = 0;
  (q - p).cwiseAbs().maxCoeff(&axis);
  const std::int32_t first = coordinate(box.low[axis]), last = coordinate(box.high[axis]);
  if (last - first > std::ssize(boxes_)) {  // looking at every triangle is cheaper
    collect_all(box);
    return candidates_;
  }
  const Vec3& start = p[axis] <= q[axis] ? p : q;
  const Vec3 along = p[axis] <= q[axis] ? Vec3(q - p) : Vec3(p - q);
  const auto at = [&](double x) -> Vec3 {
    return start + (along[axis] > 0 ? std::clamp((x - start[axis]) / along[axis], 0.0, 1.0) : 0.0) * along;
  };
  for (std::int32_t layer = first; layer <= last; ++layer) {
    const Vec3 a = at(layer * edge_ - pad), b = at((layer + 1) * edge_ + pad);
    CellRange cells{cell_of(a.cwiseMin(b).cwiseMax(box.low).array() - pad),
                    cell_of(a.cwiseMax(b).cwiseMin(box.high).array() + pad)};
    cells.low[axis] = cells.high[axis] = layer;
    collect_cells(cells, box);
  }
  collect_slot(overflow_slot_, box);
  return candidates_;
}

// Cells of the cube at the distance `shell` from the centre.
void BucketGrid::collect_shell(const CellRange& cube, const Cell& centre, std::int32_t shell,
                               const Box& box) noexcept {
  for (std::int32_t z = cube.low[2]; z <= cube.high[2]; ++z) {
    for (std::int32_t y = cube.low[1]; y <= cube.high[1]; ++y) {
      const bool whole_row = std::abs(z - centre[2]) == shell || std::abs(y - centre[1]) == shell;
      for (std::int32_t x = cube.low[0]; x <= cube.high[0]; ++x) {
        if (whole_row || std::abs(x - centre[0]) == shell) collect_slot(slot_of({x, y, z}), box);
      }
    }
  }
}

BucketGrid::CellRange BucketGrid::common(const CellRange& a, const CellRange& b) noexcept {
  CellRange both;
  for (std::size_t i = 0; i < 3; ++i) {
    both.low[i] = std::max(a.low[i], b.low[i]);
    both.high[i] = std::min(a.high[i], b.high[i]);
  }
  return both;
}

std::int32_t BucketGrid::distance_in_cells(const Cell& cell, const CellRange& range) noexcept {
  std::int32_t distance = 0;
  for (std::size_t i = 0; i < 3; ++i)
    distance = std::max({distance, range.low[i] - cell[i], cell[i] - range.high[i]});
  return distance;
}

std::optional<BucketGrid::Nearest> BucketGrid::nearest(const Vec3& p, double max_distance_m,
                                                       std::span<const Vec3> positions) noexcept {
  begin_query();
  if (!p.allFinite() || !(max_distance_m >= 0)) return std::nullopt;
  std::optional<Nearest> best;
  double reach = std::min(max_distance_m, kFarthestCell * edge_);
  std::size_t tested = 0;
  const auto box = [&] {
    return Box{p.array() - reach - kRoundingPad * edge_, p.array() + reach + kRoundingPad * edge_};
  };
  const auto test_new_candidates = [&] {
    for (; tested < candidates_.size(); ++tested) {
      const TriangleId triangle = candidates_[tested];
      const Box& around = boxes_[static_cast<std::size_t>(triangle)];
      if ((around.low - p).cwiseMax(p - around.high).cwiseMax(0.0).squaredNorm() > reach * reach) continue;
      const Triangle& t = surface_->triangles[triangle];
      const TrianglePoint point =
          closest_point_on_triangle(p, positions[t[0]], positions[t[1]], positions[t[2]]);
      if (!(point.squared_distance <= reach * reach)) continue;
      if (best && point.squared_distance >= best->squared_distance) continue;
      best = Nearest{triangle, point.barycentric, point.squared_distance};
      reach = std::sqrt(point.squared_distance);
    }
  };

  collect_slot(overflow_slot_, box());
  test_new_candidates();
  const Cell centre = cell_of(p);
  const CellRange occupied{cell_of(bounds_.low), cell_of(bounds_.high)};
  std::int64_t looked_at = 0;
  for (std::int32_t shell = distance_in_cells(centre, occupied);; ++shell) {
    const Box around = box();
    const CellRange within = common(occupied, {cell_of(around.low), cell_of(around.high)});
    if (within.count() == 0) break;
    CellRange cube{centre, centre};
    for (std::size_t i = 0; i < 3; ++i) {
      cube.low[i] -= shell;
      cube.high[i] += shell;
    }
    cube = common(cube, within);
    looked_at += cube.count();
    if (looked_at > std::ssize(boxes_)) {  // looking at every triangle is cheaper
      collect_all(around);
      test_new_candidates();
      break;
    }
    collect_shell(cube, centre, shell, around);
    test_new_candidates();
    if (cube == within) break;
  }
  return best;
}

}  // namespace omentum::geometry
