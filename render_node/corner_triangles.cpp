#include "render_node/corner_triangles.h"

#include "geometry/precondition.h"

namespace omentum::render {

// Rows of a run begin at the first corner and go to the third one; the last row is one triangle, at the
// second.
std::vector<MeshTriangle> corner_triangles(std::span<const MeshTriangle> triangles, int split) {
  geometry::require(split >= 1, "a mesh that was split");
  const auto side = static_cast<std::size_t>(split);
  geometry::require(triangles.size() % (side * side) == 0, "whole runs of triangles");
  std::vector<MeshTriangle> corners;
  corners.reserve(triangles.size() / (side * side));
  for (std::size_t first = 0; first < triangles.size(); first += side * side) {
    corners.push_back(
        {triangles[first][0], triangles[first + side * side - 1][1], triangles[first + 2 * (side - 1)][2]});
  }
  return corners;
}

}  // namespace omentum::render
