#include "geometry/gut_intersections.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <tuple>

namespace omentum::geometry {
namespace {

using Box = Eigen::AlignedBox3d;

/// Boxes around runs of columns, each parted into halves until a single one is left.
class ColumnTree {
 public:
  /// box_of(i): what the i-th column holds, 0 <= i < count.
  template <class BoxOf>
  ColumnTree(std::int32_t count, BoxOf&& box_of) : boxes_(2 * static_cast<std::size_t>(count)) {
    fill({0, count, 0}, box_of);
  }

  /// Columns begin <= i < end. Its halves follow its own box: first the left one's boxes, then the right
  /// one's.
  struct Run {
    std::int32_t begin, end;
    std::size_t place;
    bool single() const { return end - begin == 1; }
    std::array<Run, 2> halves() const {
      const std::int32_t middle = (begin + end) / 2;
      const auto left_boxes = 2 * static_cast<std::size_t>(middle - begin) - 1;
      return {Run{begin, middle, place + 1}, Run{middle, end, place + 1 + left_boxes}};
    }
  };
  Run all() const { return {0, static_cast<std::int32_t>(boxes_.size() / 2), 0}; }
  const Box& box(const Run& run) const { return boxes_[run.place]; }

 private:
  template <class BoxOf>
  void fill(const Run& run, BoxOf&& box_of) {
    if (run.single()) {
      boxes_[run.place] = box_of(run.begin);
      return;
    }
    for (const Run& half : run.halves()) {
      fill(half, box_of);
      boxes_[run.place].extend(boxes_[half.place]);
    }
  }
  std::vector<Box> boxes_;
};

// visit(i, j) for all single columns whose boxes are nearer than `reach`.
template <class Visit>
void visit_near(const ColumnTree& a, const ColumnTree::Run& run_a, const ColumnTree& b,
                const ColumnTree::Run& run_b, double reach, Visit& visit) {
  if (a.box(run_a).squaredExteriorDistance(b.box(run_b)) >= reach * reach) return;
  if (run_a.single() && run_b.single()) return visit(run_a.begin, run_b.begin);
  if (run_b.single() || (!run_a.single() && run_a.end - run_a.begin >= run_b.end - run_b.begin)) {
    for (const ColumnTree::Run& half : run_a.halves()) visit_near(a, half, b, run_b, reach, visit);
  } else {
    for (const ColumnTree::Run& half : run_b.halves()) visit_near(a, run_a, b, half, reach, visit);
  }
}

class Search {
 public:
  explicit Search(const GutShape& shape)
      : shape_(shape),
        near_(neighbourhood(shape)),
        axis_(shape.layout.segment_count(),
              [this](std::int32_t i) { return around(shape_.layout.segment(i)); }) {}

  GutOverlaps run() {
    find_in_tube();
    for (std::int32_t row = 0; row + 1 < shape_.layout.rows; ++row) find_in_row(row);
    const auto order = [](const GutOverlap& a, const GutOverlap& b) {
      return std::tie(a.segment, a.other) < std::tie(b.segment, b.other);
    };
    std::ranges::sort(found_.tube, order);
    std::ranges::sort(found_.mesentery, order);
    return std::move(found_);
  }

 private:
  template <std::size_t N>
  Box around(const std::array<MassId, N>& masses) const {
    Box box;
    for (const MassId m : masses) box.extend(shape_.positions[static_cast<std::size_t>(m)]);
    return box;
  }

  void find_in_tube() {
    const double reach = reach_of(shape_).tube_m;
    const auto test = [&](std::int32_t i, std::int32_t j) {
      if (i > j || !near_.may_touch(i, j)) return;
      const double d = distance_of_segments(shape_.layout, shape_.positions, i, j);
      if (d < reach) found_.tube.push_back({i, j, d});
    };
    visit_near(axis_, axis_.all(), axis_, axis_.all(), reach, test);
  }

  void find_in_row(std::int32_t row) {
    const double reach = reach_of(shape_).mesentery_m;
    const std::int32_t first = 2 * row * shape_.layout.segment_count();
    const ColumnTree cells(shape_.layout.segment_count(), [&](std::int32_t c) {
      return around(shape_.layout.triangle(first + 2 * c))
          .merged(around(shape_.layout.triangle(first + 2 * c + 1)));
    });
    const auto test = [&](std::int32_t i, std::int32_t c) {
      if (!near_.may_touch(i, c)) return;
      for (const std::int32_t t : {first + 2 * c, first + 2 * c + 1}) {
        const double d = distance_to_triangle(shape_.layout, shape_.positions, i, t);
        if (d < reach) found_.mesentery.push_back({i, t, d});
      }
    };
    visit_near(axis_, axis_.all(), cells, cells.all(), reach, test);
  }

  const GutShape& shape_;
  GutNeighbourhood near_;
  ColumnTree axis_;
  GutOverlaps found_;
};

}  // namespace

GutOverlaps find_overlaps(const GutShape& shape) {
  return Search(shape).run();
}

}  // namespace omentum::geometry
