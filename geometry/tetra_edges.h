// The six edges of a tetrahedron.
#pragma once

#include <array>

namespace omentum::geometry {

/// Its corners, two and two.
inline constexpr std::array<std::array<int, 2>, 6> kTetraEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

}  // namespace omentum::geometry
