// Where a triangulated surface passes through itself.
#pragma once

#include "geometry/types.h"

#include <span>
#include <utility>
#include <vector>

namespace omentum::geometry {

/// Pairs (i < j) of triangles that cross each other transversally, beyond rounding. Triangles that touch, lie
/// in one plane or share an edge are not reported: a surface may be flat, and neighbours meet. Pairs that
/// share a node are. O(F log F) for surfaces whose triangles overlap few others' bounding boxes.
std::vector<std::pair<std::size_t, std::size_t>> crossing_triangles(
    std::span<const Vec3> positions, std::span<const std::array<std::int32_t, 3>> triangles);

}  // namespace omentum::geometry
