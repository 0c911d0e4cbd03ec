// An intestine as a file that ParaView and others read.
#pragma once

#include "geometry/gut_shape.h"

#include <filesystem>

namespace omentum::gut_picture {

/// Legacy VTK, polygonal data: the axis as one line, the mesentery as triangles, all in W, m. Point data
/// radius_m: what the gut reaches around its axis, and the mesentery to either side. Whole or not at all;
/// throws std::runtime_error.
void write_gut(const std::filesystem::path& file, const geometry::GutShape& gut);

}  // namespace omentum::gut_picture
