#include "physics/membrane_strain.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace omentum::physics {

namespace {

using geometry::Vec3;

struct Stretched {
  double area_m2 = 0;  // at rest
  double strain = 0;
};

// The first edge lies along x of the plane at rest.
Stretched stretch(const Vec3& ab, const Vec3& ac, const Vec3& ab_now, const Vec3& ac_now) {
  const double length = ab.norm(), doubled = ab.cross(ac).norm();
  if (!(doubled > 0)) return {};
  const double along = ab.dot(ac) / length, height = doubled / length;
  const Vec3 x = ab_now / length, y = (ac_now - along * x) / height;  // columns of F
  const double middle = 0.5 * (x.squaredNorm() + y.squaredNorm());
  const double off = std::hypot(0.5 * (x.squaredNorm() - y.squaredNorm()), x.dot(y));
  return {0.5 * doubled, std::sqrt(middle + off) - 1};
}

Vec3 at(std::span<const float> displacements, geometry::SurfaceId s) {
  return Eigen::Map<const Eigen::Vector3f>(displacements.data() + 3 * s).cast<double>();
}

}  // namespace

MembraneStrain::MembraneStrain(const geometry::Surface& surface, const std::vector<Vec3>& rest)
    : surface_(surface), rest_(rest), sum_(rest.size()), area_m2_(rest.size()) {}

void MembraneStrain::measure(std::span<const float> displacements, std::span<float> strain) noexcept {
  std::ranges::fill(sum_, 0.0);
  std::ranges::fill(area_m2_, 0.0);
  for (const auto& [a, b, c] : surface_.triangles) {
    const Vec3 ab = rest_[b] - rest_[a], ac = rest_[c] - rest_[a], u_a = at(displacements, a);
    const Stretched t = stretch(ab, ac, ab + at(displacements, b) - u_a, ac + at(displacements, c) - u_a);
    for (const geometry::SurfaceId corner : {a, b, c}) {
      sum_[corner] += t.area_m2 * t.strain;
      area_m2_[corner] += t.area_m2;
    }
  }
  for (std::size_t s = 0; s < strain.size(); ++s)
    strain[s] = area_m2_[s] > 0 ? static_cast<float>(sum_[s] / area_m2_[s]) : 0.0F;
}

}  // namespace omentum::physics
