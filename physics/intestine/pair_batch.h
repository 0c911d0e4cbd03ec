// Distances of many pairs at once.
#pragma once

#include "physics/intestine/gut_parts.h"
#include "physics/intestine/pair_kernels.h"

namespace omentum::physics {

/// Pairs are asked for one by one, measured together, and read in the order in which they were asked for: as
/// `measure` (gut_parts.h) says, to rounding. Allocates when it is made.
///
///     batch.clear();
///     batch.ask(parts, segment, part, farthest_m);  // up to kMost times
///     batch.measure(x);
///     places = batch.next(parts, part);  // of the first that was asked for
class PairBatch {
 public:
  static constexpr std::size_t kMost = 256;

  PairBatch() : segments_(kMost), triangles_(kMost) {}

  void clear() noexcept;
  void ask(const GutParts& parts, std::int32_t segment, std::int32_t part, double farthest_m) noexcept;
  std::size_t size() const noexcept { return segments_.count + triangles_.count; }
  void measure(std::span<const geometry::Vec3> x) noexcept;
  PairPlaces next(const GutParts& parts, std::int32_t part) noexcept;

 private:
  // Of a segment with another kind of part.
  struct Kind {
    explicit Kind(std::size_t most) : corners(most), farthest_m(most), found(most) {}
    std::size_t count = 0, read = 0;
    std::vector<kernels::PartCorners> corners;
    std::vector<double> farthest_m;
    std::vector<kernels::MeasuredPair> found;
  };
  Kind segments_, triangles_;
};

}  // namespace omentum::physics
