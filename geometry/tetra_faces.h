// The four faces of a positively oriented tetrahedron.
#pragma once

#include <array>

namespace omentum::geometry {

/// Corners of the face opposite corner i, counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 3>, 4> kFaceOpposite = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace omentum::geometry
