// A map of an organ's surface as a picture that a person can read.
#pragma once

#include "organ_tools/force_map/canvas.h"
#include "organ_tools/force_map/press_map.h"

#include <optional>
#include <string>
#include <vector>

namespace omentum::force_map {

struct PictureOptions {
  Vec3 from = Vec3::UnitZ();  // the viewer is far away on this side of the organ, unit
  int width = 1280, height = 960;
  double low = 0, high = 1;        // the colours' ends
  const char* unit = "";           // of the numbers at the colours, may be empty
  std::vector<std::string> lines;  // the text above
  std::optional<double> contour;   // a value to draw a line at
  std::optional<Peak> peak;        // marked by a cross
  bool outline_regions = false;    // where the organ's regions lie inside, as a dashed line
};

/// Draws `values`, [S], by colour over the surface at rest; what has no number is grey.
Canvas draw_map(const organ::Organ& organ, const std::vector<double>& values, const PictureOptions& options);

}  // namespace omentum::force_map
