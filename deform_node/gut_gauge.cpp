#include "deform_node/gut_gauge.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace omentum::deform {

namespace {

// Of its longest edge squared. Two corners in one place are so up to rounding.
constexpr double kLeastDoubledArea = 1e-9;

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  return ab.cross(ac).norm() > kLeastDoubledArea * longest;
}

geometry::Surface mesentery_of(const geometry::GutShape& gut) {
  std::vector<geometry::Triangle> triangles;
  for (std::int32_t t = 0; t < gut.layout.triangle_count(); ++t) {
    const auto [a, b, c] = gut.layout.triangle(t);
    if (has_area(gut.positions[a], gut.positions[b], gut.positions[c]))
      triangles.push_back(
          {geometry::SurfaceId(int{a}), geometry::SurfaceId(int{b}), geometry::SurfaceId(int{c})});
  }
  return surface_of_triangles(gut.layout.mass_count(), std::move(triangles));
}

// Of the segments beside a column.
template <class Place>
double length_at(const geometry::GutLayout& layout, std::int32_t column, Place&& place) {
  double sum = 0;
  for (std::int32_t i = std::max(0, column - 1); i <= std::min(column, layout.segment_count() - 1); ++i) {
    const auto [from, to] = layout.segment(i);
    sum += (place(to) - place(from)).norm();
  }
  return sum;
}

}  // namespace

GutGauge::GutGauge(const geometry::GutShape& rest)
    : rest_(rest),
      mesentery_(mesentery_of(rest)),
      membrane_(mesentery_, rest.positions),
      u_(3 * rest.positions.size()) {}

void GutGauge::measure(const StrainedShape& shape, std::span<float> strain,
                       std::span<float> /*stress_pa*/) noexcept {
  const auto at_rest = [&](geometry::MassId m) -> const Vec3& { return rest_.positions[m]; };
  const auto now = [&](geometry::MassId m) -> Vec3 {
    return Eigen::Map<const Eigen::Vector3f>(shape.state.values.data() + 3 * m).cast<double>();
  };
  for (geometry::MassId m(0); m < rest_.layout.mass_count(); m = geometry::MassId(m + 1))
    Eigen::Map<Eigen::Vector3f>(u_.data() + 3 * m) = (now(m) - at_rest(m)).cast<float>();
  membrane_.measure(u_, strain);
  for (std::int32_t c = 0; c < rest_.layout.columns; ++c) {
    const double stretch = length_at(rest_.layout, c, now) / length_at(rest_.layout, c, at_rest);
    float& of_axis = strain[rest_.layout.mass(0, c)];
    of_axis = std::max(of_axis, static_cast<float>(stretch - 1));
  }
}

}  // namespace omentum::deform
