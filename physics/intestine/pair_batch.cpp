#include "physics/intestine/pair_batch.h"

namespace omentum::physics {

using geometry::MassId;
using geometry::Vec3;

void PairBatch::clear() noexcept {
  for (Kind* kind : {&segments_, &triangles_}) kind->count = kind->read = 0;
}

void PairBatch::ask(const GutParts& parts, std::int32_t segment, std::int32_t part,
                    double farthest_m) noexcept {
  Kind& kind = parts.is_segment(part) ? segments_ : triangles_;
  const std::array<MassId, 3>&one = parts.masses[static_cast<std::size_t>(segment)],
                           &other = parts.masses[static_cast<std::size_t>(part)];
  const auto number = [](MassId m) { return static_cast<std::int32_t>(m); };
  kind.corners[kind.count] = {{number(one[0]), number(one[1])},
                              {number(other[0]), number(other[1]), number(other[2])}};
  kind.farthest_m[kind.count++] = farthest_m;
}

void PairBatch::measure(std::span<const Vec3> x) noexcept {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const double* const of_masses = x.data()->data();
  kernels::measure_segments(segments_.count, segments_.corners.data(), of_masses, segments_.found.data());
  kernels::measure_triangles(triangles_.count, triangles_.corners.data(), of_masses,
                             triangles_.farthest_m.data(), triangles_.found.data());
}

PairPlaces PairBatch::next(const GutParts& parts, std::int32_t part) noexcept {
  Kind& kind = parts.is_segment(part) ? segments_ : triangles_;
  const kernels::MeasuredPair& found = kind.found[kind.read++];
  return {found.s, {found.weights[0], found.weights[1], found.weights[2]}, found.distance_m};
}

}  // namespace omentum::physics
