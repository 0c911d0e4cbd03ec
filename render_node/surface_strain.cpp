#include "render_node/surface_strain.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

struct Stretched {
  float area = 0;    // at rest, m^2
  float change = 0;  // the larger one of the two principal stretches', a share
};

// The first edge lies along x of the plane at rest.
Stretched stretch(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& ab_now, const Vec3f& ac_now) {
  const Vec3f ab = b - a, ac = c - a;
  const float length = ab.norm(), doubled = ab.cross(ac).norm();
  if (!(doubled > 0)) return {};
  const float along = ab.dot(ac) / length, height = doubled / length;
  const Vec3f x = ab_now / length, y = (ac_now - along * x) / height;  // columns of F
  const float middle = 0.5f * (x.squaredNorm() + y.squaredNorm());
  const float off = std::hypot(0.5f * (x.squaredNorm() - y.squaredNorm()), x.dot(y));
  const float longest = std::sqrt(middle + off), shortest = std::sqrt(std::max(0.0f, middle - off));
  return {0.5f * doubled, std::max(std::abs(longest - 1), std::abs(shortest - 1))};
}

}  // namespace

void surface_strain(std::span<const geometry::Triangle> triangles, std::span<const Vec3f> rest,
                    std::span<const Vec3f> positions, std::span<float> strain) {
  std::fill(strain.begin(), strain.end(), 0.0f);
  std::vector<float> area(strain.size(), 0.0f);
  for (const auto& [a, b, c] : triangles) {
    const Stretched t =
        stretch(rest[a], rest[b], rest[c], positions[b] - positions[a], positions[c] - positions[a]);
    for (const auto corner : {a, b, c}) {
      strain[corner] += t.area * t.change;
      area[corner] += t.area;
    }
  }
  for (std::size_t s = 0; s < strain.size(); ++s) {
    if (area[s] > 0) strain[s] /= area[s];
  }
}

const std::array<Vec3f, kStrainColourCount>& strain_colours() {
  static const std::array<Vec3f, kStrainColourCount> colours{{{0.020f, 0.016f, 0.105f},
                                                              {0.040f, 0.100f, 0.270f},
                                                              {0.020f, 0.270f, 0.240f},
                                                              {0.330f, 0.440f, 0.060f},
                                                              {0.900f, 0.660f, 0.040f}}};
  return colours;
}

}  // namespace omentum::render
