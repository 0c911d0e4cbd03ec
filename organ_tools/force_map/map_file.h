// A map as a file that ParaView and others read.
#pragma once

#include "organ_tools/force_map/press_map.h"

#include <filesystem>
#include <span>
#include <string>

namespace omentum::force_map {

/// Values of the surface's nodes, [S].
struct MapArray {
  std::string name;  // with the unit, such as force_n
  std::span<const double> values;
};

/// VTK XML (.vtu): the surface's triangles at rest, m, with `arrays` and the mesh file's own number of each
/// node (node_number) at its points. Whole or not at all. Throws std::runtime_error.
void write_map(const std::filesystem::path& file, const organ::Organ& organ,
               std::span<const MapArray> arrays);

}  // namespace omentum::force_map
