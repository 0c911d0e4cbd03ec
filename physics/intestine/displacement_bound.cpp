#include "physics/intestine/displacement_bound.h"

#include <cmath>

namespace omentum::physics {
namespace {

using geometry::Vec3;

// Ways that exceed the bound by rounding are left as they are.
constexpr double kBoundRounding = 1e-12;

// Whether it had to.
bool bound(const Vec3& before, const Vec3& v_before, double most_m, double step_s, Vec3& x, Vec3& v) {
  const Vec3 way = x - before;
  const double squared = way.squaredNorm();
  if (squared <= most_m * most_m * (1 + kBoundRounding) && v.allFinite()) return false;
  const double length = std::sqrt(squared);
  const Vec3 kept =
      std::isfinite(length) && length > 0 ? Vec3(way * std::min(1.0, most_m / length)) : Vec3(Vec3::Zero());
  x = before + kept;
  v = v_before + kept / step_s;
  return true;
}

}  // namespace

void bound_displacements(std::span<const Vec3> before, std::span<const Vec3> v_before,
                         std::span<const double> gap_m, double step_s, std::span<Vec3> x, std::span<Vec3> v,
                         std::span<std::uint8_t> held) noexcept {
  for (std::size_t m = 0; m < x.size(); ++m) {
    const Vec3 carried = m < v_before.size() ? v_before[m] : Vec3(Vec3::Zero());
    if (bound(before[m], carried, kShareOfGap * gap_m[m], step_s, x[m], v[m])) held[m] = 1;
  }
}

}  // namespace omentum::physics
