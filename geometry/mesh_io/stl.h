// Surfaces of triangles from STL files: what is only seen needs no tetrahedra.
#pragma once

#include "geometry/types.h"

#include <filesystem>
#include <vector>

namespace omentum::geometry {

struct TriangleSurface {
  std::vector<Vec3> positions;      // in the file's unit
  std::vector<Triangle> triangles;  // outward, as the file has them
};

/// Whether a file is an STL surface, by its contents; false where it cannot be read.
bool is_stl(const std::filesystem::path& file);

/// ASCII or binary. Corners in one place are one node; triangles of which two corners are one are left out.
/// Throws InputError naming file and place, and what was expected.
TriangleSurface read_stl(const std::filesystem::path& file);

}  // namespace omentum::geometry
