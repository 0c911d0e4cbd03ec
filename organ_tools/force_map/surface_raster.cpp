#include "organ_tools/force_map/surface_raster.h"

#include <algorithm>
#include <cmath>

namespace omentum::force_map {

Projection fit(const std::vector<Vec3>& points, const Vec3& from, double left, double top, double width,
               double height) {
  constexpr double kSteep = 0.9;  // looking down, up in the picture is y
  const Vec3 up = std::abs(from.z()) > kSteep ? Vec3::UnitY() : Vec3::UnitZ();
  Projection p;
  p.towards = from;
  p.right = up.cross(from).normalized();
  p.up = from.cross(p.right);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : points) box.extend(Vec3(x.dot(p.right), x.dot(p.up), x.dot(p.towards)));
  const Vec3 middle = box.center();
  p.centre = middle.x() * p.right + middle.y() * p.up + middle.z() * p.towards;
  p.pixels_per_m = std::min(width / box.sizes().x(), height / box.sizes().y());
  p.middle_x = left + width / 2;
  p.middle_y = top + height / 2;
  return p;
}

void draw_triangle(const std::array<RasterCorner, 3>& corners, const Projection& projection, Raster& raster) {
  std::array<double, 3> x{}, y{}, z{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = projection.x(corners[i].position);
    y[i] = projection.y(corners[i].position);
    z[i] = projection.nearness(corners[i].position);
  }
  const double twice_area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (twice_area == 0) return;
  const auto [left, right] = std::ranges::minmax(x);
  const auto [top, bottom] = std::ranges::minmax(y);
  for (int j = std::max(0, static_cast<int>(std::floor(top))); j <= bottom && j < raster.height; ++j) {
    for (int i = std::max(0, static_cast<int>(std::floor(left))); i <= right && i < raster.width; ++i) {
      const double px = i + 0.5, py = j + 0.5;
      const double b = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / twice_area;
      const double c = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / twice_area;
      const double a = 1 - b - c;
      if (a < 0 || b < 0 || c < 0) continue;
      const double nearness = a * z[0] + b * z[1] + c * z[2];
      const std::size_t pixel = raster.at(i, j);
      if (nearness <= raster.nearness[pixel]) continue;
      raster.nearness[pixel] = nearness;
      raster.value[pixel] = a * corners[0].value + b * corners[1].value + c * corners[2].value;
      raster.facing[pixel] = a * corners[0].facing + b * corners[1].facing + c * corners[2].facing;
    }
  }
}

}  // namespace omentum::force_map
