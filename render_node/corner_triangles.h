// The triangles that a refined mesh was made of, for pictures in which its own are smaller than a pixel or
// two.
#pragma once

#include "render_node/renderer.h"

#include <span>
#include <vector>

namespace omentum::render {

/// Of each run of split^2 triangles (surface_refinement.h) the one between its corners; a run of points, of a
/// triangle that is gone, gives a point. They use the same vertices, a part 1 / split^2 of them.
std::vector<MeshTriangle> corner_triangles(std::span<const MeshTriangle> triangles, int split);

}  // namespace omentum::render
