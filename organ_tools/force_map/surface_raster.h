// A surface as an eye far away sees it: what lies in front at each pixel.
#pragma once

#include "organ/organ.h"

#include <array>
#include <limits>
#include <vector>

namespace omentum::force_map {

using geometry::SurfaceId;
using geometry::Vec3;

/// Where points of the organ lie in a picture, orthographically. Pixels, from the left upper corner.
struct Projection {
  Vec3 right, up, towards;  // unit; towards the viewer
  Vec3 centre;              // in the middle of the picture
  double pixels_per_m = 1;
  double middle_x = 0, middle_y = 0;

  double x(const Vec3& p) const { return middle_x + pixels_per_m * (p - centre).dot(right); }
  double y(const Vec3& p) const { return middle_y - pixels_per_m * (p - centre).dot(up); }
  double nearness(const Vec3& p) const { return (p - centre).dot(towards); }
};

/// So that `points` fill a rectangle. `from`: the viewer's side, unit.
Projection fit(const std::vector<Vec3>& points, const Vec3& from, double left, double top, double width,
               double height);

/// [height][width]; what no triangle covers has no number and lies infinitely far.
struct Raster {
  int width = 0, height = 0;
  std::vector<double> nearness, value, facing;  // m; of the map; cosine between normal and viewer

  Raster(int wide, int high)
      : width(wide),
        height(high),
        nearness(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high),
                 -std::numeric_limits<double>::infinity()),
        value(nearness.size(), std::numeric_limits<double>::quiet_NaN()),
        facing(nearness.size(), 0) {}

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// A corner of a triangle.
struct RasterCorner {
  Vec3 position;
  double value = 0, facing = 0;
};

/// Draws over what is farther away.
void draw_triangle(const std::array<RasterCorner, 3>& corners, const Projection& projection, Raster& raster);

}  // namespace omentum::force_map
