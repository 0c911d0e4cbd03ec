// An intestine as a picture.
#pragma once

#include "geometry/gut_shape.h"
#include "organ_tools/force_map/canvas.h"

#include <string>
#include <vector>

namespace omentum::gut_picture {

struct PictureOptions {
  geometry::Vec3 from = geometry::Vec3::UnitZ();  // the viewer is far away on this side, unit
  int width = 1280, height = 960;
  std::vector<std::string> lines;  // the text above
};

/// The tube around its axis and the mesentery behind it, lit from the viewer, with a ruler.
force_map::Canvas draw_gut(const geometry::GutShape& gut, const PictureOptions& options);

}  // namespace omentum::gut_picture
