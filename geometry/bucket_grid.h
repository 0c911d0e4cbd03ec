// Cotin 1999, section 5: a hash of parallelepiped buckets over a deforming surface.
#pragma once

#include "geometry/surface.h"

#include <algorithm>
#include <optional>

namespace omentum::geometry {

/// Triangles of a deforming surface, binned by their bounding boxes into hashed cubic buckets. The box is
/// inflated by a slack, so that a triangle is binned again only when it has left its inflated box. The paper
/// hashes nodes and looks at the 26 neighbours; binning triangles finds every bucket a fast segment
/// crosses as well; the paper's search misses those.
///
/// No allocation after construction: each triangle owns enough list entries for all buckets that it can
/// touch, turned any way and stretched up to kStretch times its longest edge at construction. A triangle
/// stretched further, or several mean edges long, is kept in an overflow list, which every query looks
/// through: slower, never wrong. A triangle with a position that is not finite is found by no query until it
/// is updated with finite ones. One thread at a time; the surface must outlive the grid.
class BucketGrid {
 public:
  /// Growth of a triangle's longest edge that its list entries still cover: tissue that is stretched by more
  /// than a quarter is far beyond what the linear model can say.
  static constexpr double kStretch = 1.25;

  /// Bucket edge: the mean triangle edge at `positions` ([S], m). Throws std::invalid_argument unless
  /// 0 < slack_m < bucket edge.
  BucketGrid(const Surface& surface, std::span<const Vec3> positions, double slack_m);

  /// The slack that suits the surface: a quarter of its mean triangle edge at `positions`, m.
  static double suitable_slack(const Surface& surface, std::span<const Vec3> positions);

  /// Tells where one triangle's vertices are now. Cheap when it stayed inside its inflated box.
  void update(TriangleId triangle, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
    const Vec3 low = a.cwiseMin(b).cwiseMin(c);
    const Vec3 high = a.cwiseMax(b).cwiseMax(c);
    const Box& box = boxes_[static_cast<std::size_t>(triangle)];
    if ((low.array() >= box.low.array()).all() && (high.array() <= box.high.array()).all()) return;
    move_triangle(triangle, low, high);
  }

  /// The same for the three nodes of a triangle in `positions`, [S].
  void update(TriangleId triangle, std::span<const Vec3> positions) noexcept {
    const Triangle& t = surface_->triangles[static_cast<std::size_t>(triangle)];
    update(triangle, positions[t[0]], positions[t[1]], positions[t[2]]);
  }

  /// Calls visit(TriangleId) once for each triangle that the segment p -> q, grown by radius_m, may touch:
  /// those in the buckets it crosses whose inflated box meets the bounding box of what of it lies near the
  /// surface. Exact positions are the caller's to test. `visit` must not query the grid. No visits when p or
  /// q is not finite.
  template <class Visit>
  void visit_segment(const Vec3& p, const Vec3& q, double radius_m, Visit&& visit) {
    for (const TriangleId triangle : segment_candidates(p, q, radius_m)) visit(triangle);
  }

  /// The point of the surface nearest to p, at most max_distance_m away; nothing when there is none or p is
  /// not finite. `positions`: [S], m, those of the newest updates. Exact, unlike the paper's search for the
  /// nearest node and the triangles of its fan: shells of buckets around p until no farther one can hold a
  /// nearer point.
  struct Nearest {
    TriangleId triangle;
    Vec3 barycentric;
    double squared_distance;
  };
  std::optional<Nearest> nearest(const Vec3& p, double max_distance_m,
                                 std::span<const Vec3> positions) noexcept;

  double slack() const { return slack_; }
  /// Triangles in the overflow list now.
  std::int32_t overflow_count() const { return overflow_count_; }

 private:
  struct Box {
    Vec3 low, high;  // low > high: holds nothing
  };
  using Cell = std::array<std::int32_t, 3>;
  // Buckets from low to high, both included.
  struct CellRange {
    Cell low{0, 0, 0}, high{-1, -1, -1};
    bool contains(const Cell& cell) const {
      return cell[0] >= low[0] && cell[0] <= high[0] && cell[1] >= low[1] && cell[1] <= high[1] &&
             cell[2] >= low[2] && cell[2] <= high[2];
    }
    std::int64_t count() const {
      std::int64_t product = 1;
      for (std::size_t i = 0; i < 3; ++i) product *= std::max(high[i] - low[i] + 1, 0);
      return product;
    }
    bool operator==(const CellRange&) const = default;
  };
  // A member of one bucket's doubly linked list. `previous` is ~slot for the first member.
  struct Entry {
    std::int32_t previous, next, triangle;
  };
  // The entries of one triangle: a cube of `side`^3, addressed by the cell's coordinates modulo `side`, so
  // that a triangle that moves keeps the entries of the buckets that it stays in.
  struct Block {
    std::int32_t first, side;
  };

  std::int32_t coordinate(double x) const noexcept;
  Cell cell_of(const Vec3& p) const noexcept {
    return {coordinate(p.x()), coordinate(p.y()), coordinate(p.z())};
  }
  std::int32_t slot_of(const Cell& cell) const noexcept;
  std::int32_t entry_of(const Block& block, const Cell& cell) const noexcept;
  void link(std::int32_t entry, std::int32_t slot, std::int32_t triangle) noexcept;
  void unlink(std::int32_t entry) noexcept;
  void rebin(std::int32_t triangle, const CellRange& cells) noexcept;
  void move_triangle(TriangleId triangle, const Vec3& low, const Vec3& high) noexcept;

  std::span<const TriangleId> segment_candidates(const Vec3& p, const Vec3& q, double radius_m) noexcept;
  void begin_query() noexcept;
  void collect_slot(std::int32_t slot, const Box& box) noexcept;
  void collect_cells(const CellRange& cells, const Box& box) noexcept;
  void collect_shell(const CellRange& cube, const Cell& centre, std::int32_t shell, const Box& box) noexcept;
  static CellRange common(const CellRange& a, const CellRange& b) noexcept;
  static std::int32_t distance_in_cells(const Cell& cell, const CellRange& range) noexcept;
  void collect_all(const Box& box) noexcept;
  void collect_triangle(std::int32_t triangle, const Box& box) noexcept;

  const Surface* surface_;
  double edge_, slack_;
  double cells_per_metre_;
  std::int32_t bits_;           // of a cell's coordinate that count in its slot
  std::int32_t overflow_slot_;  // behind the buckets' slots
  std::int32_t overflow_count_ = 0;
  std::vector<std::int32_t> heads_;  // [slots + 1], -1: empty
  std::vector<Entry> entries_;
  std::vector<Block> blocks_;        // [F]
  std::vector<Box> boxes_;           // [F], inflated
  std::vector<CellRange> ranges_;    // [F], empty: in no bucket
  std::vector<bool> in_overflow_;    // [F]
  std::vector<std::uint32_t> seen_;  // [F], the newest query that collected the triangle
  std::uint32_t query_ = 0;
  std::vector<TriangleId> candidates_;  // capacity F
  Box bounds_;                          // of all inflated boxes ever
};

}  // namespace omentum::geometry
